#pragma once
#include <cstdint>
#include <functional>

#include "core/contact/common_drift.h"
#include "coupling/mechanics/workspace.h"

namespace morula {

/// What all spheres of all ranks do in common where nothing holds them: the affine motion that fits their ways best. A ball of cells that grows carries its
/// rim along, and nobody comes nearer to a neighbour by it. None of fewer than a thousand, in periodic boxes and beside obstacles. The same bits on any
/// number of threads and ranks. Collective.
[[nodiscard]] CommonDrift common_way_of_spheres(const Workspace& work, const std::function<Vec3d(std::uint32_t)>& way_of_point);

}  // namespace morula
