#pragma once
#include <cmath>
#include <numbers>

namespace morula::dcm {

/// Contact of the cortex, from inside, with a rigid sphere: per area of the cortex U(g) = ½ k_r g² for g < 0, g = |x − X| − R_n; nothing
/// holds the two together (dcm.md §12, the traction law of §7 with W = 0). A point of the cortex has one nearest point on a sphere, so that
/// no choice of a side is left.
///
/// k_r [kPa/µm], g [µm]; U [nN/µm].
struct NucleusRepulsion {
  double repulsion;  // k_r

  [[nodiscard]] double energy(double gap) const noexcept { return gap < 0.0 ? 0.5 * repulsion * gap * gap : 0.0; }
  /// ∂U/∂g, negative: it pushes apart.
  [[nodiscard]] double slope(double gap) const noexcept { return gap < 0.0 ? repulsion * gap : 0.0; }
  /// ∂²U/∂g²
  [[nodiscard]] double curvature_psd(double gap) const noexcept { return gap < 0.0 ? repulsion : 0.0; }
};

/// Drag of a sphere in the cytoplasm: ζ = 6π η R_n (Stokes), against the area-mean velocity of the cortex v̄ = Σ a_i v_i/A. The friction is
/// ζ b bᵀ with b = (1, −a_i/A): of rank one for each component, and without net force (dcm.md §12). A sphere without contact friction feels
/// no torque.
///
/// η [kPa·s], R_n [µm]; ζ [nN·s/µm].
struct CytoplasmDrag {
  double viscosity;  // η

  [[nodiscard]] double coefficient(double radius) const noexcept { return 6.0 * std::numbers::pi * viscosity * radius; }
};

}  // namespace morula::dcm
