#pragma once
#include <cstdint>
#include <vector>

#include "core/mesh/lane_blocks.h"
#include "core/parallel/threads.h"
#include "dcm/shells.h"

namespace morula::dcm {

/// How the shells of a rank are computed in lanes. Good until shells are added, removed or get another Topology.
struct ShellBlocks {
  std::vector<LaneBlock> blocks;
  std::vector<std::uint32_t> first_face{0};  ///< by shell, one more at the end: into arrays by face
  int threads = 1;                           ///< that work on the blocks; results do not depend on it

  [[nodiscard]] std::uint32_t face_count() const { return first_face.back(); }
};

/// Group the shells by Topology in their order, `max_lanes` (1, 4 or 8) at a time. Results do not depend on the width. Shells with computed[shell] == 0
/// are in no block; an empty list means that all are.
ShellBlocks make_shell_blocks(const Shells& shells, int max_lanes = LaneBlock::kMaxLanes, std::span<const char> computed = {});

/// Run `kernel.operator()<W>(block number, block, workspace)` for one block.
template <class Workspace, class Kernel>
void for_block(const ShellBlocks& blocks, std::size_t b, const Kernel& kernel, Workspace& workspace) {
  const LaneBlock& block = blocks.blocks[b];
  switch (block.lanes) {
    case 8:
      return kernel.template operator()<8>(b, block, workspace);
    case 4:
      return kernel.template operator()<4>(b, block, workspace);
    default:
      return kernel.template operator()<1>(b, block, workspace);
  }
}

/// The same for every block, in parallel; each thread has one Workspace.
template <class Workspace, class Kernel>
void for_each_block(const ShellBlocks& blocks, const Kernel& kernel) {
  parallel_for_with<Workspace>(blocks.threads, blocks.blocks.size(),
                               [&](std::size_t b, Workspace& workspace) { for_block(blocks, b, kernel, workspace); });
}

}  // namespace morula::dcm
