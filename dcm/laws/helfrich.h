#pragma once
#include "core/vec3.h"

namespace morula::dcm {

/// Bending of a fluid or elastic sheet after Helfrich: E = ½ κ ∮ (2H − c0)² dA, H the mean curvature (1/R on a sphere), c0 the
/// spontaneous curvature. The Gaussian part is constant on a closed surface and left out.
///
/// Discrete form, with the gradient of the area (the cotangent formula), g_i = ∂A/∂x_i = 2H n a, the node area a_i = ⅓ Σ A_T, and the
/// unit normal n_i along ∂V/∂x_i:
///
///   E = ½ κ Σ a_i |w_i|²,  w_i = g_i/a_i − c0 n_i.
///
/// A sum of squares: never negative, whatever c0. With c0 = 0 it is κ/2 Σ |g_i|²/a_i and free of scale. The gradient follows from
/// δE = κ Σ w_i·δg_i + Σ β_i δa_i − κ c0 Σ a_i w_i·δn_i with β_i = κ (½ |w_i|² − w_i·g_i/a_i), where δg is the Hessian of the area times δx
/// and δn_i = (1 − n nᵀ) δ(∂V/∂x_i)/|∂V/∂x_i|; both Hessians are symmetric, so that each term is one Hessian times a vector.
///
/// On icospheres E/(8πκ) = 0.9824, 0.9956, 0.9989 for 162, 642, 2562 nodes (dcm.md: T3.1): second order. Source: Helfrich 1973,
/// doi:10.1515/znc-1973-11-1209; Meyer et al. 2003, doi:10.1007/978-3-662-05105-4_2; Guckenberger & Gekle 2017,
/// doi:10.1088/1361-648X/aa6313.
///
/// κ [nN·µm], c0 [1/µm]; energy [fJ].
template <class Real>
struct Helfrich {
  Real rigidity;   // κ
  Real curvature;  // c0

  /// w_i
  Vec3<Real> excess(const Vec3<Real>& area_gradient, Real node_area, const Vec3<Real>& normal) const noexcept {
    return area_gradient / node_area - normal * curvature;
  }
  Real energy(const Vec3<Real>& w, Real node_area) const noexcept { return Real(0.5) * rigidity * node_area * norm2(w); }
  /// β_i
  Real node_area_slope(const Vec3<Real>& w, const Vec3<Real>& area_gradient, Real node_area) const noexcept {
    return rigidity * (Real(0.5) * norm2(w) - dot(w, area_gradient) / node_area);
  }
  /// u_i of the term κ c0 (Hessian of the volume) u: −a_i (1 − n nᵀ) w_i/|∂V/∂x_i| = −(1 − n nᵀ) g_i/|∂V/∂x_i|
  Vec3<Real> volume_vector(const Vec3<Real>& area_gradient, const Vec3<Real>& normal, Real inverse_volume_slope) const noexcept {
    return (normal * dot(normal, area_gradient) - area_gradient) * (rigidity * curvature * inverse_volume_slope);
  }
  /// Weight of the Gauss–Newton part κ/a_i h_i h_iᵀ, h_i = ∂(n_i·g_i)/∂x with fixed cotangents and normals.
  Real gauss_newton_weight(Real node_area) const noexcept { return rigidity / node_area; }
};

}  // namespace morula::dcm
