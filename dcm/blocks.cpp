#include "dcm/blocks.h"

namespace morula::dcm {

ShellBlocks make_shell_blocks(const Shells& shells, int max_lanes, std::span<const char> computed) {
  std::vector<const Topology*> topologies;
  ShellBlocks out;
  topologies.reserve(shells.size());
  out.first_face.reserve(shells.size() + 1);
  for (const auto& shape : shells.shape) {
    const bool left_out = !computed.empty() && computed[topologies.size()] == 0;
    topologies.push_back(left_out ? nullptr : shape->topology.get());
    out.first_face.push_back(out.first_face.back() + shape->topology->face_count());
  }
  out.blocks = group_by_topology(topologies, max_lanes);
  return out;
}

}  // namespace morula::dcm
