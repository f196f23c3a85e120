#pragma once
#include "core/vec3.h"

namespace morula::dcm {

/// Bending of the hinge at an edge: E = ½ k_h (θ − θ0)², θ the dihedral turning angle (0 flat, > 0 convex).
///
/// k_h = (2/√3) κ for the plate modulus κ = E h³/(12 (1 − ν²)), calibrated on cylinders; on a sphere with θ0 = 0 it gives about
/// 8πκ/3 because of its Gaussian modulus −4κ/3 (Gompper & Kroll 1996; Schmidt & Fraternali 2012). With Table-1 values of the cortex
/// it regularises, the elasto-bending length is far below an edge (dcm.md §0).
///
/// k_h [nN·µm], θ and θ0 [rad]; energy [fJ], slope ∂E/∂θ [nN·µm].
template <class Real>
struct HingeBending {
  Real stiffness;  // k_h

  Real energy(Real angle, Real rest_angle) const noexcept {
    const Real turn = angle - rest_angle;
    return Real(0.5) * stiffness * turn * turn;
  }
  Real slope(Real angle, Real rest_angle) const noexcept { return stiffness * (angle - rest_angle); }
  /// ∂²E/∂θ²; Gauss–Newton: K = k_h ∇θ ∇θᵀ. The step treats hinges explicitly that are weak against the tension (time_stepping.md §10.1).
  Real curvature_psd() const noexcept { return stiffness; }
};

}  // namespace morula::dcm
