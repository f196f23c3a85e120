#pragma once
#include <cassert>
#include <numbers>

#include "core/numbers/cube_root.h"
#include "core/simd/lane.h"

namespace morula::cbm {

/// What a contact law says at one overlap. Force > 0 pushes apart.
template <class Real>
struct ContactResponse {
  Real force{};           ///< F [nN]
  Real stiffness{};       ///< positive semi-definite part max(0, dF/dδ) [nN/µm]
  Real contact_radius{};  ///< a [µm]
  Real area{};            ///< πa² [µm²]
  Real energy{};          ///< U with dU/dδ = F; 0 out of contact [nN·µm]
};

/// Contact of two elastic materials: everything that does not depend on the radii.
///
/// 1/E* = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j (Johnson, Kendall & Roberts 1971, doi:10.1098/rspa.1971.0141).
struct ContactMaterial {
  double modulus = 0.0;        ///< E* [kPa]
  double adhesion = 0.0;       ///< W per contact area of the pair; two equal surfaces of energy γ have W = 2γ [nN/µm]
  double length_factor = 0.0;  ///< (π²W²/E*²)^(1/3), so that X = length_factor · R*^(1/3)
  double radius_factor = 0.0;  ///< (πW/E*)^(1/3), so that a_s = radius_factor · R*^(2/3)

  /// Both bodies elastic. Preconditions: E > 0, −1 < ν ≤ 0.5, W ≥ 0.
  static constexpr ContactMaterial elastic(double young_i, double poisson_i, double young_j, double poisson_j, double adhesion) noexcept {
    assert(young_i > 0.0 && young_j > 0.0 && poisson_i > -1.0 && poisson_i <= 0.5 && poisson_j > -1.0 && poisson_j <= 0.5);
    return of_modulus(1.0 / ((1.0 - poisson_i * poisson_i) / young_i + (1.0 - poisson_j * poisson_j) / young_j), adhesion);
  }
  /// The second body is rigid: E* = E/(1 − ν²).
  static constexpr ContactMaterial against_rigid(double young, double poisson, double adhesion) noexcept {
    assert(young > 0.0 && poisson > -1.0 && poisson <= 0.5);
    return of_modulus(young / (1.0 - poisson * poisson), adhesion);
  }
  static constexpr ContactMaterial of_modulus(double modulus, double adhesion) noexcept {
    assert(modulus > 0.0 && adhesion >= 0.0);
    ContactMaterial material{modulus, adhesion, 0.0, 0.0};
    if (adhesion > 0.0) {
      material.radius_factor = cube_root(std::numbers::pi * adhesion / modulus);
      material.length_factor = material.radius_factor * material.radius_factor;
    }
    return material;
  }
};

/// Contact of two bodies: material and effective radius together, with the scales of the adhesive law ready.
///
/// R* = R_i R_j/(R_i + R_j) for two spheres and R* = R for a sphere on a plane. X = (π²W²R*/E*²)^(1/3) and a_s = (πWR*²/E*)^(1/3).
template <class Real>
struct PairLaw {
  Real modulus{};         ///< E* [kPa]
  Real reduced_radius{};  ///< R* [µm]
  Real length{};          ///< X [µm]; 0 without adhesion
  Real inverse_length{};  ///< 1/X [1/µm]; 0 without adhesion
  Real radius{};          ///< a_s [µm]; 0 without adhesion
  Real force{};           ///< πWR* [nN]; 0 without adhesion
};

/// The scales of a pair; one cube root, and none without adhesion.
constexpr PairLaw<double> make_pair_law(const ContactMaterial& material, double reduced_radius) noexcept {
  assert(reduced_radius > 0.0);
  PairLaw<double> law{.modulus = material.modulus, .reduced_radius = reduced_radius};
  if (material.adhesion > 0.0) {
    const double root = cube_root(reduced_radius);
    law.length = material.length_factor * root;
    law.inverse_length = 1.0 / law.length;
    law.radius = material.radius_factor * (root * root);
    law.force = std::numbers::pi * material.adhesion * reduced_radius;
  }
  return law;
}
constexpr double reduced_radius(double radius_i, double radius_j) noexcept { return radius_i * radius_j / (radius_i + radius_j); }
/// Two spheres.
constexpr PairLaw<double> make_pair_law(const ContactMaterial& material, double radius_i, double radius_j) noexcept {
  return make_pair_law(material, reduced_radius(radius_i, radius_j));
}

}  // namespace morula::cbm
