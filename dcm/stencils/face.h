#pragma once
#include "core/vec3.h"

namespace morula::dcm {

/// A triangle (x0, x1, x2), counter-clockwise from outside; e_c is the edge opposite to corner c.
template <class Real>
struct FaceStencil {
  Vec3<Real> e0, e1, e2;
  Vec3<Real> twice_area_vector;  ///< N = (x1 − x0) × (x2 − x0), outward

  static FaceStencil of(const Vec3<Real>& x0, const Vec3<Real>& x1, const Vec3<Real>& x2) noexcept {
    const Vec3<Real> e0 = x2 - x1, e1 = x0 - x2, e2 = x1 - x0;
    return {e0, e1, e2, cross(e1, e2)};
  }
  /// Σ l²
  Real square_sum() const noexcept { return norm2(e0) + norm2(e1) + norm2(e2); }
};

/// −∂E/∂x of an energy of area A and Σl² at the three corners: ∂A/∂x_c = ½ n × e_c (dcm.md §4), ∂Σl²/∂x_0 = 2 (e1 − e2), cyclic.
template <class Real>
struct FaceForce {
  Vec3<Real> f0, f1, f2;

  static FaceForce of(const FaceStencil<Real>& face, Real inverse_twice_area, Real area_slope, Real square_sum_slope) noexcept {
    const Vec3<Real> w = face.twice_area_vector * (area_slope * inverse_twice_area * Real(0.5));
    const Real s = square_sum_slope * Real(2.0);
    const Vec3<Real> f0 = cross(face.e0, w) - (face.e1 - face.e2) * s;
    const Vec3<Real> f1 = cross(face.e1, w) - (face.e2 - face.e0) * s;
    return {f0, f1, -(f0 + f1)};
  }
};

}  // namespace morula::dcm
