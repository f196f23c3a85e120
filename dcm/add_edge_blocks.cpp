#include <algorithm>

#include "core/mesh/lane_surface.h"
#include "dcm/operator_assembly.h"

namespace morula::dcm {

template <int W>
void add_contact_edges(const LaneBlock& block, const EdgeBlockSource& contacts, OperatorWorkspace& ws, LaneVector<float>& edge) {
  using Real = Lane<float, W>;
  constexpr std::size_t kSize = sizeof(EdgeBlock) / sizeof(float);
  const std::size_t edges = block.topology->edge_count();
  bool any = false;
  std::array<const float*, W> cell;
  for (int lane = 0; lane < W; ++lane) {
    if (lane < block.count) {
      ws.cell[lane].assign(edges, {});
      any = contacts(block.member[lane], ws.cell[lane]) || any;
    }
    cell[lane] = ws.cell[std::min(lane, block.count - 1)].data()->m;  // empty lanes repeat the last shell
  }
  if (!any) return;
  ws.contact_lanes.resize(std::max(ws.contact_lanes.size(), edges * kSize * W));
  load_lanes<W, float>(cell, edges * kSize, ws.contact_lanes.data());
  for (std::size_t k = 0; k < edges; ++k)
    for (std::size_t c = 0; c < 6; ++c) {
      float* const m = edge.data() + (k * 6 + c) * W;
      (Real::load(m) + Real::load(ws.contact_lanes.data() + (k * kSize + c) * W)).store(m);
    }
}

template void add_contact_edges<1>(const LaneBlock&, const EdgeBlockSource&, OperatorWorkspace&, LaneVector<float>&);
template void add_contact_edges<4>(const LaneBlock&, const EdgeBlockSource&, OperatorWorkspace&, LaneVector<float>&);
template void add_contact_edges<8>(const LaneBlock&, const EdgeBlockSource&, OperatorWorkspace&, LaneVector<float>&);

}  // namespace morula::dcm
