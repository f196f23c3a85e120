#include <algorithm>

#include "core/mesh/lane_surface.h"
#include "dcm/shell_operator.h"

namespace morula::dcm {
namespace {

struct Workspace {
  std::vector<EdgeBlock> cell[LaneBlock::kMaxLanes];  ///< by lane: its edges
  LaneVector<float> lanes;
};

template <int W>
void add_block(const LaneBlock& block, const EdgeBlockSource& source, ShellOperator::Block& out, Workspace& ws) {
  using Real = Lane<float, W>;
  constexpr std::size_t kSize = sizeof(EdgeBlock) / sizeof(float);
  const std::size_t edges = block.topology->edge_count();
  bool any = false;
  std::array<const float*, W> cell;
  for (int lane = 0; lane < W; ++lane) {
    if (lane < block.count) {
      ws.cell[lane].assign(edges, {});
      any = source(block.member[lane], ws.cell[lane]) || any;
    }
    cell[lane] = ws.cell[std::min(lane, block.count - 1)].data()->m;  // empty lanes repeat the last shell
  }
  if (!any) return;
  ws.lanes.resize(std::max(ws.lanes.size(), edges * kSize * W));
  load_lanes<W, float>(cell, edges * kSize, ws.lanes.data());
  for (std::size_t k = 0; k < edges; ++k)
    for (std::size_t c = 0; c < 6; ++c) {
      float* const m = out.edge.data() + (k * 6 + c) * W;
      (Real::load(m) + Real::load(ws.lanes.data() + (k * kSize + c) * W)).store(m);
    }
}

}  // namespace

void add_edge_blocks(const ShellBlocks& blocks, const EdgeBlockSource& source, ShellOperator& out) {
  for_each_block<Workspace>(
      blocks, [&]<int W>(std::size_t b, const LaneBlock& block, Workspace& ws) { add_block<W>(block, source, out.blocks[b], ws); });
}

}  // namespace morula::dcm
