#pragma once
#include "core/vec3.h"

namespace morula::dcm {

/// Linear spring along a mesh edge: E = ½ k (l − l0)².
///
/// The stiffness of a hexagonal spring sheet with Young's modulus E_cor and thickness h is k = (√3/2) E_cor h, and its Poisson
/// ratio is 1/3 whatever the input says (Seung & Nelson 1988, doi:10.1103/PhysRevA.38.1005).
///
/// k [nN/µm], l and l0 [µm]; energy [fJ = nN·µm], slope ∂E/∂l [nN]. Real is double, float or a lane.
template <class Real>
struct EdgeSpring {
  Real stiffness;  // k

  Real energy(Real length, Real rest_length) const noexcept {
    const Real stretch = length - rest_length;
    return Real(0.5) * stiffness * stretch * stretch;
  }
  Real slope(Real length, Real rest_length) const noexcept { return stiffness * (length - rest_length); }
  /// Positive semi-definite part of ∂²E/∂(x_i − x_j)²: k [t tᵀ + max(0, 1 − l0/l) (I − t tᵀ)], t the unit direction. The geometric part
  /// is dropped under compression (time_stepping.md §1).
  SymMat3<Real> stiffness_psd(const Vec3<Real>& t, Real length, Real rest_length) const noexcept {
    const Real across = stiffness * max(Real(0.0), Real(1.0) - rest_length / length);
    return outer(stiffness - across, t) + isotropic(across);
  }
};

}  // namespace morula::dcm
