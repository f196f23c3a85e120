#pragma once
#include <numbers>

namespace morula::dcm {

/// k = (√3/2) E h of the springs of a cortex of Young's modulus E [kPa] and thickness h [µm]; [nN/µm] (Seung & Nelson 1988,
/// doi:10.1103/PhysRevA.38.1005).
constexpr double spring_stiffness(double young_modulus, double thickness) { return 0.5 * std::numbers::sqrt3 * young_modulus * thickness; }

/// κ = E h³ / (12 (1 − ν²)) of a plate; [nN·µm].
constexpr double bending_modulus(double young_modulus, double thickness, double poisson_ratio) {
  return young_modulus * thickness * thickness * thickness / (12.0 * (1.0 - poisson_ratio * poisson_ratio));
}

/// k_h = (2/√3) κ of the hinges, calibrated on cylinders and plates (dcm.md §3); [nN·µm].
constexpr double hinge_stiffness(double young_modulus, double thickness, double poisson_ratio) {
  return 2.0 / std::numbers::sqrt3 * bending_modulus(young_modulus, thickness, poisson_ratio);
}

}  // namespace morula::dcm
