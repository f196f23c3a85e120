#pragma once
#include <cmath>

namespace morula::dcm {

/// Pressure of the cytoplasm: E = K_V [V ln(V/V0) − V + V0], p = −∂E/∂V = −K_V ln(V/V0).
///
/// Natural logarithm, V > 0. Source: Van Liedekerke et al. 2020, doi:10.1007/s10237-019-01204-7; one pressure per cell, whose nodal
/// force is p ∂V/∂x. It is evaluated once per cell, so that it needs no lanes.
///
/// K_V and p [kPa], volumes [µm³], energy [fJ].
struct VolumePressure {
  double bulk_modulus;  // K_V

  [[nodiscard]] double energy(double volume, double reference_volume) const noexcept {
    return bulk_modulus * (volume * std::log(volume / reference_volume) - (volume - reference_volume));
  }
  [[nodiscard]] double pressure(double volume, double reference_volume) const noexcept {
    return -bulk_modulus * std::log(volume / reference_volume);
  }
  /// ∂²E/∂V²; Gauss–Newton: K = (K_V/V) g gᵀ, g = ∂V/∂x; the part −p ∂²V/∂x² is indefinite and left out.
  [[nodiscard]] double curvature_psd(double volume) const noexcept { return bulk_modulus / volume; }
};

/// Viscosity of the volume: p = −η_V V̇/V. With V̇ = u·v, u = ∂V/∂x, it is the friction (η_V/V) u uᵀ: of rank one, and positive
/// semi-definite; it resists no rigid motion (dcm.md §5).
///
/// η_V [kPa·s].
struct BulkViscosity {
  double viscosity;  // η_V

  [[nodiscard]] double friction(double volume) const noexcept { return viscosity / volume; }
};

}  // namespace morula::dcm
