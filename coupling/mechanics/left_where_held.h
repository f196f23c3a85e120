#pragma once
#include <span>

#include "coupling/mechanics/workspace.h"

namespace morula {

/// The residual of the cells that obstacles touch which have moved in this step, and of those that springs hold, over the forces that contacts and springs
/// exert on them; 0 where there are none. It is what forces on these obstacles and of these springs are told wrongly by. The same bits on any number of
/// threads and ranks. Collective.
[[nodiscard]] double left_where_held(const Workspace& work, const Tissue& tissue, std::span<const Vec3d> residual);

}  // namespace morula
