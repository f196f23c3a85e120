#pragma once
#include <numbers>

#include "core/vec3.h"

namespace morula::dcm {

/// Barrier that keeps an edge from folding through π: E = k_d z²/(1 − z²), z = (|θ| − θ_b)/(π − θ_b) for |θ| > θ_b, else 0.
///
/// Without it edges fold through π in strongly adhesive clusters and the sign of the contact gap flips (time_stepping.md §9.1: H;
/// k_d = 1 nN·µm, θ_b = 1.6 rad).
///
/// k_d [nN·µm], θ and θ_b [rad]; energy [fJ], slope ∂E/∂θ [nN·µm].
template <class Real>
struct DihedralBarrier {
  Real stiffness;  // k_d
  Real onset;      // θ_b

  /// z; 0 where the barrier does not act.
  Real depth(Real angle) const noexcept { return max(Real(0.0), (abs(angle) - onset) / (Real(std::numbers::pi) - onset)); }
  Real energy(Real angle) const noexcept {
    const Real z = depth(angle);
    return stiffness * z * z / (Real(1.0) - z * z);
  }
  Real slope(Real angle) const noexcept {
    const Real z = depth(angle), rest = Real(1.0) - z * z;
    const Real slope = Real(2.0) * stiffness * z / (rest * rest * (Real(std::numbers::pi) - onset));
    return select(angle < Real(0.0), -slope, slope);
  }
  /// ∂²E/∂θ² ≥ 0 (E is convex in θ); Gauss–Newton: K = E″ ∇θ ∇θᵀ.
  Real curvature_psd(Real angle) const noexcept {
    const Real z = depth(angle), rest = Real(1.0) - z * z, width = Real(std::numbers::pi) - onset;
    const Real curvature = stiffness * (Real(2.0) + Real(6.0) * z * z) / (rest * rest * rest * width * width);
    return select(z > Real(0.0), curvature, Real(0.0));
  }
};

}  // namespace morula::dcm
