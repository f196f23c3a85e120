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

/// Energies and forces of all internal laws (the conservative ones of shell_laws()) at `position`, which need not be that of the shells (a
/// trial state); rest lengths, rest volumes and reference volumes are the shells'. `types[t]` are the parameters of cell type t.
///
/// Lanes over shells of one Topology, in parallel over blocks: the same bits for every lane width and number of threads.
void internal_forces(const ShellBlocks& blocks, const Shells& shells, std::span<const ShellParameters> types,
                     std::span<const Vec3d> position, ShellMechanics& out);
/// The same, with the forces to `force` (by node).
void internal_forces(const ShellBlocks& blocks, const Shells& shells, std::span<const ShellParameters> types,
                     std::span<const Vec3d> position, std::span<Vec3d> force, ShellMechanics& out);

}  // namespace morula::dcm
