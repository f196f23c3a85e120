#pragma once
#include "core/vec3.h"

namespace morula::dcm {

/// Tension of the actomyosin cortex: E = γ A, the same in every face whatever its strain.
///
/// Magnitude in living cells: 0.2 mN/m in interphase, 1.6 mN/m in metaphase (Fischer-Friedrich et al. 2014, doi:10.1038/srep06213).
/// A sphere of radius R holds the Laplace pressure 2γ/R.
///
/// γ [nN/µm], A [µm²]; energy [fJ], slope ∂E/∂A [nN/µm].
template <class Real>
struct CorticalTension {
  Real tension;  // γ

  Real energy(Real area) const noexcept { return tension * area; }
  Real slope() const noexcept { return tension; }
  /// Weight w of the positive semi-definite stiffness w · S ⊗ n nᵀ, S_ab = e_a·e_b/(4A) (the cotangent Laplacian, Dziuk 1991; Pinkall &
  /// Polthier 1993): the normal part of the Hessian of the area. Adhesion U per area of the face lowers the tension; a negative sum is
  /// cut off. S is positive semi-definite for obtuse triangles too, since vᵀSv = A |∇v|².
  Real stiffness_weight(Real contact_energy) const noexcept { return max(Real(0.0), tension + contact_energy); }
};

}  // namespace morula::dcm
