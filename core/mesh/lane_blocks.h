#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/topology.h"

namespace morula {

/// Up to 8 surfaces of one Topology that are computed at once, one per lane. Empty lanes repeat the last surface, so that a kernel may
/// treat all lanes alike; they write the same bits to the same place.
struct LaneBlock {
  static constexpr int kMaxLanes = 8;
  const Topology* topology = nullptr;
  int lanes = 1;                                  ///< width the kernels use: 1, 4 or 8
  int count = 1;                                  ///< surfaces in the block, at most `lanes`
  std::array<std::uint32_t, kMaxLanes> member{};  ///< which surface is in each lane
};

/// Group surfaces by Topology, in the order in which they come. Full blocks have `max_lanes` lanes (1, 4 or 8); what is left over of a
/// Topology goes to the narrowest width that holds it. Results of the kernels do not depend on the grouping. Surfaces without a Topology (null)
/// are left out.
std::vector<LaneBlock> group_by_topology(std::span<const Topology* const> topologies, int max_lanes = LaneBlock::kMaxLanes);

}  // namespace morula
