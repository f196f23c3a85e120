#pragma once
#include <cstdint>
#include <numbers>
#include <string>

namespace morula {

/// Restoring force of marked faces towards their mean sphere, over all cells: F = −µ v − k d per area, d the distance from the sphere along its radius
/// (dcm.md §15).
struct ApicalSpring {
  std::string name;
  int mark = 0;            ///< bit of the faces' mark
  double stiffness = 0.0;  ///< k per marked area [nN/µm³]
  double friction = 0.0;   ///< µ per marked area [nN·s/µm³]
};

/// Fluctuations of the shells and spheres of a type that belong to its friction by the fluctuation–dissipation theorem (dcm.md §10).
struct Fluctuations {
  double energy = 0.0;   ///< k_B T of an effective temperature; 0: none [nN·µm]
  double resolve = 0.0;  ///< shortest relaxation time of a mode whose variance shall be right; 0: steps are not limited [s]

  /// Longest step with which the variance of a mode of relaxation time τ is right within 3 %: the implicit step gives
  /// ⟨q²⟩ = (k_B T/k)/(1 + Δt/(2τ)).
  [[nodiscard]] double longest_step() const { return 0.06 * resolve; }
};

/// Protrusion at the leading edge of a shell (dcm.md §11).
struct Protrusion {
  double force = 0.0;                     ///< F_p; 0: none [nN]
  double angle = std::numbers::pi / 4.0;  ///< half angle of the front about the polarity [rad]
  bool internal = false;                  ///< the rear bears −F_p: motion only through what the surface rubs on or adheres to
  int substrate = -1;                     ///< material that the front must be in touch with, to which the force is tangential; -1: none
  double contact_area =
      0.0;  ///< A_ref: the force is F_p·min(1, A_contact/A_ref) of the cell's contact with the substrate; 0: always F_p [µm²]
};

}  // namespace morula
