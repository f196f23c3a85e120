#pragma once
#include "core/simd/atan2.h"
#include "core/vec3.h"

namespace morula::dcm {

/// Two faces at an edge i–j: (i, j, k) on the left and (j, i, l) on the right; N1 and N2 are their doubled area vectors, outward.
///
/// θ = atan2((N1 × N2)·e/|e|, N1·N2), e = x_j − x_i. Never by acos, which loses the sign and accuracy at 0 (dcm.md §3).
template <class Real>
Real hinge_angle(const Vec3<Real>& n1, const Vec3<Real>& n2, const Vec3<Real>& direction) noexcept {
  return lane_atan2(dot(cross(n1, n2), direction), dot(n1, n2));
}

/// ∂θ/∂x at the four nodes (dcm.md §3): ∂θ/∂x_k = −(|e|/|N1|²) N1, ∂θ/∂x_l = −(|e|/|N2|²) N2 and, with t_k = (x_k − x_i)·e/|e|²,
/// ∂θ/∂x_j = −[t_k ∂θ/∂x_k + t_l ∂θ/∂x_l]; the four sum to zero.
template <class Real>
struct HingeGradient {
  Vec3<Real> i, j, k, l;

  /// `to_k`, `to_l`: x_k − x_i and x_l − x_i; `inverse_n1`, `inverse_n2`: 1/|N1|², 1/|N2|².
  static HingeGradient of(const Vec3<Real>& e, Real length, Real inverse_length, const Vec3<Real>& to_k, const Vec3<Real>& to_l,
                          const Vec3<Real>& n1, Real inverse_n1, const Vec3<Real>& n2, Real inverse_n2) noexcept {
    const Real inverse_square = inverse_length * inverse_length;
    HingeGradient g;
    g.k = n1 * (-(length * inverse_n1));
    g.l = n2 * (-(length * inverse_n2));
    g.j = -(g.k * (dot(to_k, e) * inverse_square) + g.l * (dot(to_l, e) * inverse_square));
    g.i = -(g.j + (g.k + g.l));
    return g;
  }
};

}  // namespace morula::dcm
