#pragma once
#include <cmath>
#include <numbers>

#include "core/simd/lane.h"

namespace morula {

/// Traction of two surfaces at gap g (g < 0: overlap), per area of contact, from a potential.
///
/// Attraction: U_a = −W for g ≤ 0, −W + ½ω g² up to c/2, −½ω (c − g)² up to c, 0 beyond, with ω = 4W/c², so that the work of separation
/// is exactly W and the traction is a tent of height 2W/c. Repulsion: U_r = ½ k_r g² for g < 0. Both are C¹ (dcm.md §7a; time_stepping.md
/// §9: O). With a cap δ the repulsion grows linearly beyond depth δ (start from deep overlap).
///
/// W [nN/µm], c and g [µm], k_r [kPa/µm]; potentials [nN/µm], derivatives [kPa], curvatures [kPa/µm].
struct TractionLaw {
  double adhesion = 0.0;    ///< W
  double range = 0.5;       ///< c
  double repulsion = 40.0;  ///< k_r
  double cap = 0.0;         ///< δ; 0: no cap

  template <class Real>
  struct Part {
    Real energy, slope, curvature;
  };

  /// Curvature is the positive semi-definite part: 4W/c² on the rising flank, 0 on the falling one ("projected"). For a double or a lane.
  template <class Real>
  [[nodiscard]] Part<Real> attraction(Real g) const noexcept {
    const Real zero(0.0), omega(4.0 * adhesion / (range * range)), bound(-adhesion), rest = Real(range) - g;
    const auto touching = g <= zero, rising = g < Real(0.5 * range), within = g < Real(range);
    return {
        select(touching, bound, select(rising, bound + Real(0.5) * omega * g * g, select(within, Real(-0.5) * omega * rest * rest, zero))),
        select(touching, zero, select(rising, omega * g, select(within, omega * rest, zero))),
        select(touching, zero, select(rising, omega, zero))};
  }

  template <class Real>
  [[nodiscard]] Part<Real> repulse(Real g) const noexcept {
    const Real zero(0.0), stiffness(repulsion);
    const auto inside = g < zero;
    Part<Real> part{Real(0.5) * stiffness * g * g, stiffness * g, stiffness};
    if (cap > 0.0) {
      const Real most(repulsion * cap), depth = -g;
      const auto capped = depth > Real(cap);
      part.energy = select(capped, most * (depth - Real(0.5 * cap)), part.energy);
      part.slope = select(capped, -most, part.slope);
      part.curvature = select(capped, most / depth, part.curvature);
    }
    return {select(inside, part.energy, zero), select(inside, part.slope, zero), select(inside, part.curvature, zero)};
  }
};

/// Foundation stiffness k_w with which a sphere gives way to a surface, its own share of the flattening [kPa/µm].
///
/// A Winkler foundation on a plane carries π k_w R δ² and the attraction pulls 2π R W (Derjaguin), so that the sphere's half W/2 of the
/// adhesion balances it at δ² = W/k_w. Two such spheres rest at an overlap δ0 = a0²/(3R*), a0³ = 9πWR*²/(2E*) (Johnson, Kendall & Roberts 1971,
/// doi:10.1098/rspa.1971.0141; R* = R/2, E* = E′/2): each gives δ0/2. Both agree when k_w = 4W/δ0² = 4E′/(π a0), which is the form
/// 4E′/(3π a_ref) of fields_and_coupling.md, D, with a_ref = a0/3. A sphere that hardly adheres (a0 < 0.3 R) is met at its Hertz force instead:
/// a_ref goes linearly to 0.3 R at W = 0.
///
/// modulus: E′ = E/(1 − ν²) [kPa]; adhesion: W of the pair [nN/µm]; radius: R [µm].
inline double sphere_foundation(double modulus, double adhesion, double radius) noexcept {
  const double unloaded = std::cbrt(9.0 * std::numbers::pi * adhesion * radius * radius / (4.0 * modulus));  // a0
  const double reference = unloaded > 0.3 * radius ? unloaded / 3.0 : 0.3 * radius - (2.0 / 3.0) * unloaded;
  return 4.0 * modulus / (3.0 * std::numbers::pi * reference);
}

/// Weight of attraction between faces that look at each other: 1 when opposed, 0 when not, smooth between.
///
/// φ(m) is the smoothstep of m = −n_q·n_y from −0.3 to 0.5 (time_stepping.md §9: O).
template <class Real>
struct SmoothWeight {
  Real value, slope;
};
struct OpposedWeight {
  static constexpr double kLow = -0.3, kHigh = 0.5;

  template <class Real>
  static SmoothWeight<Real> of(Real m) noexcept {
    const Real zero(0.0), one(1.0), t = (m - Real(kLow)) * Real(1.0 / (kHigh - kLow));
    const auto opposed = m >= Real(kHigh), averted = m <= Real(kLow);
    return {select(opposed, one, select(averted, zero, t * t * (Real(3.0) - Real(2.0) * t))),
            select(opposed, zero, select(averted, zero, Real(6.0 / (kHigh - kLow)) * t * (one - t)))};
  }
};

/// Part of the contact friction that acts at gap g: 1 up to c/2, falling smoothly to 0 at c (dcm.md §1).
template <class Real>
Real friction_weight(Real g, double range) noexcept {
  const Real zero(0.0), one(1.0), t = (Real(range) - g) * Real(2.0 / range);
  return select(t >= one, one, select(t <= zero, zero, t * t * (Real(3.0) - Real(2.0) * t)));
}

/// Share of a point's area that counts as contact area: 1 up to c/2, falling linearly to 0 at c.
template <class Real>
Real contact_ramp(Real g, double range) noexcept {
  const Real zero(0.0), one(1.0), t = (Real(range) - g) * Real(2.0 / range);
  return select(t >= one, one, select(t <= zero, zero, t));
}

/// Interior quadrature points of a face: barycentric weights; every point stands for the same part of the area.
struct FaceQuadrature {
  int count;
  double weight[4][3];

  /// 3 points at (2/3, 1/6, 1/6), or 4 centroids of the four sub-triangles.
  static const FaceQuadrature& with_points(int points) noexcept {
    static constexpr double a = 2.0 / 3.0, b = 1.0 / 6.0, c = 1.0 / 3.0;
    static constexpr FaceQuadrature three{3, {{a, b, b}, {b, a, b}, {b, b, a}, {c, c, c}}};
    static constexpr FaceQuadrature four{4, {{a, b, b}, {b, a, b}, {b, b, a}, {c, c, c}}};
    return points == 4 ? four : three;
  }
};

}  // namespace morula
