#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/simd/transpose.h"
#include "dcm/blocks.h"
#include "dcm/shells.h"

namespace morula::dcm {

/// The shells' own friction Γ_n, frozen at the start of a step: dampers along the edges of that state (and in all directions), friction of
/// its node areas against the medium, viscosity of its volume. Directions of edges are found anew from the start's positions at each use:
/// that is cheaper than to fetch them.
struct ShellFriction {
  struct Block {
    LaneVector<double> medium;                                     ///< γ_med a: [node][lane] [nN·s/µm]
    std::array<double, LaneBlock::kMaxLanes> damping;              ///< γ_int by lane [nN·s/µm]
    std::array<double, LaneBlock::kMaxLanes> isotropic_damping{};  ///< γ_iso by lane [nN·s/µm]
    std::array<double, LaneBlock::kMaxLanes> bulk_friction{};      ///< η_V/V by lane [kPa·s/µm³]
    LaneVector<double> volume_gradient;  ///< u = ∂V/∂x: [node][component][lane] [µm²]; empty when no shell has bulk viscosity
    bool isotropic = false;              ///< some shell has γ_iso
  };
  std::vector<Block> blocks;
  std::span<const Vec3d> start;  ///< positions of the step's start, by node of the shells: the caller keeps them as they are
};

/// Γ_n at the positions and node areas of the step's start; `position` must live and stay as long as `out` is used. `node_area` is indexed
/// as the shells' nodes (SurfaceGeometry::node_area).
void compute_shell_friction(const ShellBlocks& blocks, const Shells& shells, const ShellMaterials& materials,
                            std::span<const Vec3d> position, std::span<const double> node_area, ShellFriction& out);

/// result = Γ_n d by node, and quadratic = dᵀ Γ_n d by shell, in double: the nonlinear residual and the objective Φ of a step need both.
/// With d a displacement [µm] the result is in nN·s, and divided by Δt a force.
void friction_times_displacement(const ShellBlocks& blocks, const Shells& shells, const ShellFriction& friction,
                                 std::span<const Vec3d> displacement, std::span<Vec3d> result, std::span<double> quadratic);

/// The same for d = position − start: adds Γ_n d to `result`.
void add_friction_of_motion(const ShellBlocks& blocks, const Shells& shells, const ShellFriction& friction, std::span<const Vec3d> position,
                            std::span<Vec3d> result, std::span<double> quadratic);

}  // namespace morula::dcm
