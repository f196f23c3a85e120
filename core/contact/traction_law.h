#pragma once
#include <cmath>
#include <numbers>

#include "core/simd/lane.h"

namespace morula {

/// Traction of two surfaces at gap g (g < 0: overlap), per area of contact, from a potential.
///
/// Attraction: the traction rises linearly from 0 at g = 0 to its peak at a, keeps it up to b, and falls linearly to 0 at the range c. The
/// peak is 2W/(c + b − a), so that the work of separation is exactly W; U_a = −W for g ≤ 0. a = b = c/2 is a tent (dcm.md §7a;
/// time_stepping.md §9: O), a → 0 with b → c the constant stress of Dugdale (Maugis 1992, doi:10.1016/0021-9797(92)90285-T), a = b → 0 a
/// traction that only falls.
/// Repulsion, g < 0: U_r = ½ k_r g², or like a Hertz contact 2/3 κ |g|^{3/2}. With κ = E*/(π √R) a sphere of radius R that is pressed
/// by δ into a plane carries 4/3 E* √R δ^{3/2} in all, as Hertz has it.
/// Both are C¹. With a cap δ the repulsion grows linearly beyond depth δ (start from deep overlap).
///
/// W [nN/µm], a, b, c and g [µm], k_r [kPa/µm], κ [kPa/µm^{1/2}]; potentials [nN/µm], derivatives [kPa], curvatures [kPa/µm].
struct TractionLaw {
  double adhesion = 0.0;    ///< W
  double range = 0.5;       ///< c
  double repulsion = 40.0;  ///< k_r
  double cap = 0.0;         ///< δ; 0: no cap
  double flat_from = 0.5;   ///< a/c, > 0
  double flat_to = 0.5;     ///< b/c, from a/c to below 1
  double hertz = 0.0;       ///< κ; 0: the repulsion is k_r |g|

  template <class Real>
  struct Part {
    Real energy, slope, curvature;
  };

  /// Curvature is the positive semi-definite part: that of the rising flank, 0 on the flat and on the falling one ("projected"). For a
  /// double or a lane.
  template <class Real>
  [[nodiscard]] Part<Real> attraction(Real g) const noexcept {
    const double a = flat_from * range, b = flat_to * range, span = (1.0 + (flat_to - flat_from)) * range;
    const double down = 2.0 * adhesion / (span * ((1.0 - flat_to) * range)), peak = 2.0 * adhesion / span;
    const Real zero(0.0), omega(2.0 * adhesion / (span * a)), bound(-adhesion), rest = Real(range) - g;
    const auto touching = g <= zero, rising = g < Real(a), flat = g < Real(b), within = g < Real(range);
    const Real falling = select(within, Real(-0.5 * down) * rest * rest, zero), falling_slope = select(within, Real(down) * rest, zero);
    return {select(touching, bound,
                   select(rising, bound + Real(0.5) * omega * g * g, select(flat, bound + Real(peak) * (g - Real(0.5 * a)), falling))),
            select(touching, zero, select(rising, omega * g, select(flat, Real(peak), falling_slope))),
            select(touching, zero, select(rising, omega, zero))};
  }

  template <class Real>
  [[nodiscard]] Part<Real> repulse(Real g) const noexcept {
    const Real zero(0.0), depth = -g;
    Part<Real> part = hertz > 0.0 ? hertz_at(depth) : Part<Real>{Real(0.5 * repulsion) * g * g, Real(repulsion) * g, Real(repulsion)};
    if (cap > 0.0) {
      const Part<double> end = hertz > 0.0 ? hertz_at(cap) : Part<double>{0.5 * repulsion * cap * cap, -(repulsion * cap), 0.0};
      const auto capped = depth > Real(cap);
      part.energy = select(capped, Real(end.energy) - Real(end.slope) * (depth - Real(cap)), part.energy);
      part.slope = select(capped, Real(end.slope), part.slope);
      part.curvature = select(capped, Real(-end.slope) / depth, part.curvature);
    }
    const auto inside = g < zero;
    return {select(inside, part.energy, zero), select(inside, part.slope, zero), select(inside, part.curvature, zero)};
  }

 private:
  /// The curvature of a Hertz contact has no bound as the depth goes to 0; steps need a finite one.
  template <class Real>
  [[nodiscard]] Part<Real> hertz_at(Real depth) const noexcept {
    using std::sqrt;
    const Real least(0.02 * range), kappa(hertz);
    const Real root = sqrt(select(depth > Real(0.0), depth, Real(0.0)));
    return {Real(2.0 / 3.0) * kappa * root * depth, -kappa * root, Real(0.5) * kappa / sqrt(select(depth > least, depth, least))};
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

/// Share of a point's area that is told as contact area: what is nearer than half the range, 1 up to c/4, falling linearly to 0 at 3c/4 so that no
/// point counts all at once. Nothing acts by it.
template <class Real>
Real contact_share(Real g, double range) noexcept {
  const Real zero(0.0), one(1.0), t = (Real(0.75 * range) - g) * Real(2.0 / range);
  return select(t >= one, one, select(t <= zero, zero, t));
}

}  // namespace morula
