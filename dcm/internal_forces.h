#pragma once
#include <span>
#include <vector>

#include "dcm/blocks.h"
#include "dcm/shell_fault.h"
#include "dcm/shells.h"

namespace morula::dcm {

/// What the membrane and the pressure of every shell do at some positions.
struct ShellMechanics {
  std::vector<Vec3d> force;         ///< −∂E/∂x by node [nN]; empty where they went elsewhere
  std::vector<double> energy;       ///< E by shell [fJ]
  std::vector<double> volume;       ///< enclosed, by shell [µm³]
  std::vector<double> pressure;     ///< −K_V ln(V/V0), by shell [kPa]
  std::vector<double> min_quality;  ///< smallest q of a face, by shell
  std::vector<double> max_angle;    ///< largest |θ| of an edge, by shell [rad]
  std::vector<ShellFault> fault;    ///< by shell; energy and force of a faulty shell are not to be used
};

/// What a shell holds that is not its cytosol, such as a nucleus with a membrane of its own: the pressure is that of the cytosol, whose volume
/// V − V_h is 1 − f of the shell's at rest (dcm.md §12): p = −K_V ln(V'/V0) and E = (1 − f) K_V [V' ln(V'/V0) − V' + V0] with
/// V' = (V − V_h)/(1 − f).
struct HeldVolume {
  double volume = 0.0;  ///< V_h [µm³]
  double part = 0.0;    ///< f

  /// V': that of the shell if it were all cytosol [µm³].
  [[nodiscard]] double cytosol(double shell_volume) const { return (shell_volume - volume) / (1.0 - part); }
};

/// Energies and forces of all internal laws (the conservative ones of shell_laws()) at `position`, which need not be that of the shells (a
/// trial state); rest lengths, rest volumes and reference volumes are the shells'. `materials`: of their types, or of each.
///
/// Lanes over shells of one Topology, in parallel over blocks: the same bits for every lane width and number of threads. `held`: by shell, or
/// empty: nothing.
void internal_forces(const ShellBlocks& blocks, const Shells& shells, const ShellMaterials& materials, std::span<const Vec3d> position,
                     ShellMechanics& out);
/// The same, with the forces to `force` (by node).
void internal_forces(const ShellBlocks& blocks, const Shells& shells, const ShellMaterials& materials, std::span<const Vec3d> position,
                     std::span<Vec3d> force, ShellMechanics& out, std::span<const HeldVolume> held = {});

}  // namespace morula::dcm
