#pragma once
#include <span>

#include "coupling/mechanics/workspace.h"

namespace morula {

/// The residual of the cells that obstacles touch which have moved in this step, over the forces that their contacts exert; 0 where none is touched. It is
/// what forces on these obstacles are told wrongly by. The same bits on any number of threads and ranks. Collective.
[[nodiscard]] double left_at_moved_obstacles(const Workspace& work, std::span<const Vec3d> residual);

}  // namespace morula
