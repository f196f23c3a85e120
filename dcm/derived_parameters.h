#pragma once
#include <numbers>

namespace morula::dcm {

/// k = (√3/2) E h of the springs of a cortex of Young's modulus E [kPa] and thickness h [µm]; [nN/µm] (Seung & Nelson 1988,
/// doi:10.1103/PhysRevA.38.1005).
constexpr double spring_stiffness(double young_modulus, double thickness) { return 0.5 * std::numbers::sqrt3 * young_modulus * thickness; }

/// G = E h/(2 (1 + ν)) of a thin sheet of an isotropic solid; [nN/µm].
constexpr double sheet_shear_modulus(double young_modulus, double thickness, double poisson_ratio) {
  return young_modulus * thickness / (2.0 * (1.0 + poisson_ratio));
}

/// ν/(1 − ν): the Lamé modulus of a sheet in units of 2G; α of the neo-Hookean, C of Skalak's law.
constexpr double sheet_area_ratio(double poisson_ratio) { return poisson_ratio / (1.0 - poisson_ratio); }

/// Springs that together with an area modulus of every face have Young's modulus E h and Poisson ratio ν ≥ 1/3 (dcm.md §2): the lattice
/// has the shear modulus √3/4 k and the area modulus √3/2 k. [nN/µm]
struct SpringsWithArea {
  double spring_stiffness, area_modulus;
};
constexpr SpringsWithArea springs_with_area(double young_modulus, double thickness, double poisson_ratio) {
  const double sheet = young_modulus * thickness, square = poisson_ratio * poisson_ratio;
  return {2.0 * sheet / (std::numbers::sqrt3 * (1.0 + poisson_ratio)), sheet * (3.0 * poisson_ratio - 1.0) / (2.0 * (1.0 - square))};
}

/// κ = E h³ / (12 (1 − ν²)) of a plate; [nN·µm].
constexpr double bending_modulus(double young_modulus, double thickness, double poisson_ratio) {
  return young_modulus * thickness * thickness * thickness / (12.0 * (1.0 - poisson_ratio * poisson_ratio));
}

/// k_h = (2/√3) κ of the hinges, calibrated on cylinders and plates (dcm.md §3); [nN·µm].
constexpr double hinge_stiffness(double bending_modulus) { return 2.0 / std::numbers::sqrt3 * bending_modulus; }
constexpr double hinge_stiffness(double young_modulus, double thickness, double poisson_ratio) {
  return hinge_stiffness(bending_modulus(young_modulus, thickness, poisson_ratio));
}

/// k_s of the triangle shape term: 0.3 γ, which lets a cortex flow (contact radius and angle within 0.4 % and 0.6° at 0.2 γ; 1.5 % and 1.4° short at
/// 0.6 γ) and still holds 13 cells at W/2γ = 0.9 (0.15 γ does not; time_stepping.md §12.1). A layer that is more elastic than tense, such as that of a
/// nucleus, takes a tenth of its modulus E h: springs resist shear, but not that a triangle turns inside out. A surface with neither takes as much
/// as one of 0.1 mN/m. [nN/µm]
constexpr double shape_stiffness(double tension, double sheet_modulus) {
  constexpr double kOfTension = 0.3, kOfModulus = 0.1, kOfNothing = 0.03;
  const double of_tension = kOfTension * tension, of_modulus = kOfModulus * sheet_modulus;
  const double out = of_tension > of_modulus ? of_tension : of_modulus;
  return out > 0.0 ? out : kOfNothing;
}
/// Part of the tension from which the shape term of a fluid cortex is told to be an elasticity (ibid.).
inline constexpr double kStiffShape = 0.6;

}  // namespace morula::dcm
