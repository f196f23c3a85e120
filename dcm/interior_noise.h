#pragma once
#include <cstddef>
#include <span>

#include "dcm/interior.h"
#include "dcm/nuclear_shell.h"

namespace morula::dcm {

/// Factors G of the friction of what is inside a cell, Γ = Σ_k G_k G_kᵀ: the drag of the cytoplasm has √ζ along each axis for every point that it
/// drags on, a damper √c along its direction. With independent normal numbers ξ, Σ_k G_k ξ_k has the covariance Γ (dcm.md §10).

/// How many factors the friction of a rigid nucleus and of links has.
[[nodiscard]] std::size_t interior_factor_count(const InteriorView& cell);
/// Adds Σ_k G_k ξ_k to the forces of the nodes and of the nucleus (null if there is none). `normal`: ξ, one for each factor.
void add_interior_noise(const InteriorView& cell, const InteriorFriction& friction, std::span<const double> normal, std::span<Vec3d> force,
                        Vec3d* nucleus_force);

/// The same of a nucleus that is a shell: its drag and its links.
[[nodiscard]] std::size_t nuclear_factor_count(const NucleusView& view);
void add_nuclear_noise(const NucleusView& view, const NuclearFriction& friction, std::span<const double> normal, NucleusVectors force);

}  // namespace morula::dcm
