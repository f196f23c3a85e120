#pragma once
#include <span>

#include "core/contact/rigid_surface.h"
#include "core/parallel/comm.h"
#include "coupling/model.h"
#include "coupling/tissue.h"

namespace morula {

/// Longest step [s] from the tissue's time on in which no obstacle that moves comes nearer to the centre of a cell than a tenth of the cell's radius within where it
/// touches it, or within where it is already; infinity where none comes so near until `until` [s], which lies before the next corner of their
/// courses. Cells count as balls of their target volume. What moves in one step past a cell would never touch it, and what is deep in it would throw it anywhere.
/// The same on every rank. Collective where an obstacle moves.
[[nodiscard]] double longest_step_of_obstacles(const Model& model, const Tissue& tissue, std::span<const RigidSurface> obstacles,
                                               double until, int threads, const Comm& comm);

}  // namespace morula
