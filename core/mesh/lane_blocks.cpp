#include "core/mesh/lane_blocks.h"

#include <unordered_map>

namespace morula {
namespace {

void finish(LaneBlock& block, int max_lanes) {
  block.lanes = block.count == 1 ? 1 : block.count <= 4 ? 4 : 8;
  if (block.lanes > max_lanes) block.lanes = max_lanes;
  for (int lane = block.count; lane < LaneBlock::kMaxLanes; ++lane) block.member[lane] = block.member[block.count - 1];
}

}  // namespace

std::vector<LaneBlock> group_by_topology(std::span<const Topology* const> topologies, int max_lanes) {
  std::vector<LaneBlock> blocks;
  std::unordered_map<const Topology*, std::size_t> open;  // the last block of each topology
  for (std::size_t surface = 0; surface < topologies.size(); ++surface) {
    if (topologies[surface] == nullptr) continue;
    const auto [place, is_new] = open.try_emplace(topologies[surface], blocks.size());
    if (is_new || blocks[place->second].count == max_lanes) {
      place->second = blocks.size();
      blocks.push_back({.topology = topologies[surface], .count = 0});
    }
    LaneBlock& block = blocks[place->second];
    block.member[block.count++] = static_cast<std::uint32_t>(surface);
  }
  for (LaneBlock& block : blocks) finish(block, max_lanes);
  return blocks;
}

}  // namespace morula
