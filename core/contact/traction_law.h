#pragma once
#include <cmath>
#include <numbers>

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

  struct Attraction {
    double energy, slope, curvature;
  };
  struct Repulsion {
    double energy, slope, curvature;
  };

  /// Curvature is the positive semi-definite part: 4W/c² on the rising flank, 0 on the falling one ("projected").
  [[nodiscard]] Attraction attraction(double g) const noexcept {
    if (g >= range) return {0.0, 0.0, 0.0};
    if (g <= 0.0) return {-adhesion, 0.0, 0.0};
    const double omega = 4.0 * adhesion / (range * range);
    if (g < 0.5 * range) return {-adhesion + 0.5 * omega * g * g, omega * g, omega};
    const double rest = range - g;
    return {-0.5 * omega * rest * rest, omega * rest, 0.0};
  }

  [[nodiscard]] Repulsion repulse(double g) const noexcept {
    if (g >= 0.0) return {0.0, 0.0, 0.0};
    if (cap > 0.0 && -g > cap) return {repulsion * cap * (-g - 0.5 * cap), -repulsion * cap, repulsion * cap / -g};
    return {0.5 * repulsion * g * g, repulsion * g, repulsion};
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
struct OpposedWeight {
  static constexpr double kLow = -0.3, kHigh = 0.5;
  double value, slope;

  static OpposedWeight of(double m) noexcept {
    if (m >= kHigh) return {1.0, 0.0};
    if (m <= kLow) return {0.0, 0.0};
    const double t = (m - kLow) / (kHigh - kLow);
    return {t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) / (kHigh - kLow)};
  }
};

/// Part of the contact friction that acts at gap g: 1 up to c/2, falling smoothly to 0 at c (dcm.md §1).
inline double friction_weight(double g, double range) noexcept {
  const double t = (range - g) / (0.5 * range);
  if (t >= 1.0) return 1.0;
  if (t <= 0.0) return 0.0;
  return t * t * (3.0 - 2.0 * t);
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
