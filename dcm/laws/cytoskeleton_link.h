#pragma once
#include "core/vec3.h"

namespace morula::dcm {

/// A viscoelastic link between two points of a cell (Kelvin–Voigt): F = [k_l (ℓ − ℓ0) + c_l ℓ̇] t, t along the link. E = ½ k_l (ℓ − ℓ0)².
///
/// With `tension_only` it goes slack below ℓ0, as a filament does. Damping is a friction: c_l t tᵀ on the relative velocity, of rank one; it
/// resists no rigid motion. Source: the links of Van Liedekerke et al. 2020, doi:10.1007/s10237-019-01204-7.
///
/// k_l [nN/µm], c_l [nN·s/µm], lengths [µm]; energy [fJ].
struct CytoskeletonLink {
  double stiffness;  // k_l
  double damping;    // c_l
  bool tension_only = false;

  [[nodiscard]] bool slack(double length, double rest) const noexcept { return tension_only && length < rest; }
  [[nodiscard]] double energy(double length, double rest) const noexcept {
    return slack(length, rest) ? 0.0 : 0.5 * stiffness * (length - rest) * (length - rest);
  }
  /// Pull along the link, > 0 when it is stretched.
  [[nodiscard]] double pull(double length, double rest) const noexcept { return slack(length, rest) ? 0.0 : stiffness * (length - rest); }
  /// Positive semi-definite part of ∂²E/∂d²: k [t tᵀ + max(0, 1 − ℓ0/ℓ)(I − t tᵀ)].
  [[nodiscard]] SymMat3<double> stiffness_psd(const Vec3d& direction, double length, double rest) const noexcept {
    if (slack(length, rest)) return {};
    const double across = length > rest ? stiffness * (1.0 - rest / length) : 0.0;
    return outer(stiffness - across, direction) + isotropic(across);
  }
};

}  // namespace morula::dcm
