#pragma once
#include <numbers>

#include "core/vec3.h"

namespace morula::dcm {

/// Keeps triangles from collapsing where the cortex has no shear stiffness: E = k_s A_ref (1/q − 1)², q = 4√3 A/Σl² the quality of the
/// triangle (1: equilateral), A_ref its area in the reference shape at the rest volume.
///
/// It has no shear modulus at q = 1 and depends on shape only, not on size (time_stepping.md §9: Q; k_s = 0.3 nN/µm).
///
/// k_s [nN/µm], areas [µm²], Σl² [µm²]; energy [fJ]; slopes ∂E/∂A and ∂E/∂Σl² [nN/µm].
template <class Real>
struct TriangleShape {
  Real stiffness;  // k_s

  static constexpr double kEquilateral = 4.0 * std::numbers::sqrt3;

  /// 1/q
  static Real inverse_quality(Real inverse_area, Real square_sum) noexcept { return square_sum * inverse_area * (1.0 / kEquilateral); }
  Real energy(Real inverse_quality, Real reference_area) const noexcept {
    const Real excess = inverse_quality - Real(1.0);
    return stiffness * reference_area * excess * excess;
  }
  /// ∂E/∂A at constant Σl²
  Real area_slope(Real inverse_quality, Real inverse_area, Real reference_area) const noexcept {
    return Real(-2.0) * stiffness * reference_area * (inverse_quality - Real(1.0)) * inverse_quality * inverse_area;
  }
  /// ∂E/∂Σl² at constant A; never negative, so that its part of the Hessian, 2 ∂E/∂Σl² per edge, is positive semi-definite.
  Real square_sum_slope(Real inverse_quality, Real inverse_area, Real reference_area) const noexcept {
    return stiffness * reference_area * (inverse_quality - Real(1.0)) * inverse_area * Real(2.0 / kEquilateral);
  }
  /// Weight w of the Gauss–Newton part w ∇(1/q) ∇(1/q)ᵀ
  Real gauss_newton_weight(Real reference_area) const noexcept { return Real(2.0) * stiffness * reference_area; }
};

}  // namespace morula::dcm
