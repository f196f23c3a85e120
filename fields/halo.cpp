#include "fields/halo.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace morula::fields {

std::size_t layer_size(const std::array<std::int32_t, 3>& n, std::size_t side) {
  const std::size_t axis = side / 2;
  return static_cast<std::size_t>(n[axis == 0 ? 1 : 0]) * static_cast<std::size_t>(n[axis == 2 ? 1 : 2]);
}

namespace {

/// The brick beyond a side, or -1 at a face of the domain.
std::int64_t neighbour(const Grid& grid, const Space& space, std::int64_t brick, std::size_t side) {
  const std::size_t axis = side / 2;
  auto p = grid.place(brick);
  p[axis] += (side % 2) ? 1 : -1;
  if (p[axis] < 0 || p[axis] >= grid.bricks[axis]) {
    if (!space.periodic(static_cast<int>(axis))) return -1;
    p[axis] = (p[axis] + grid.bricks[axis]) % grid.bricks[axis];
  }
  return grid.brick_at(p);
}

/// What goes to or comes from a rank, as a part of a buffer.
struct Stretch {
  int rank;
  std::size_t begin, end;
};

}  // namespace

template <class Value>
Halo<Value>::Halo(const Field& field, const Layout& layout, const Space& space, const Comm& comm)
    : layout_(layout), comm_(comm), sources_(layout.bricks()) {
  const auto& bricks = field.owned_bricks;
  const auto local = [&](std::int64_t brick) {
    return static_cast<std::size_t>(std::lower_bound(bricks.begin(), bricks.end(), brick) - bricks.begin());
  };
  // Both ends of a message list its layers by (brick that wants it, its side), so that no header is needed.
  using Wanted = std::tuple<std::int64_t, std::size_t>;
  std::map<int, std::map<Wanted, Layer>> to_send, to_receive;
  for (std::size_t b = 0; b < bricks.size(); ++b) {
    for (std::size_t side = 0; side < kSides; ++side) {
      const std::int64_t other = neighbour(field.grid, space, bricks[b], side);
      if (other < 0) continue;
      const int rank = field.owner[static_cast<std::size_t>(other)];
      if (rank == comm.rank()) {
        sources_[b][side] = {GhostSource::Kind::kSameRank, local(other)};
        continue;
      }
      to_receive[rank][{bricks[b], side}] = {b, side};
      to_send[rank][{other, side ^ 1u}] = {b, side};
    }
  }
  std::vector<Stretch> sends, receives;
  for (const auto& [rank, layers] : to_receive) {
    const std::size_t begin = received_.size();
    for (const auto& [wanted, layer] : layers) {
      sources_[layer.brick][layer.side] = {GhostSource::Kind::kOtherRank, received_.size()};
      received_.resize(received_.size() + layer_size(layout.extent[layer.brick], layer.side));
    }
    receives.push_back({rank, begin, received_.size()});
  }
  for (const auto& [rank, layers] : to_send) {
    const std::size_t begin = sent_.size();
    for (const auto& [wanted, layer] : layers) {
      sent_layers_.push_back(layer);
      sent_.resize(sent_.size() + layer_size(layout.extent[layer.brick], layer.side));
    }
    sends.push_back({rank, begin, sent_.size()});
  }
  for (const Stretch& s : sends) sendings_.push_back({s.rank, std::as_bytes(std::span(sent_).subspan(s.begin, s.end - s.begin))});
  for (const Stretch& r : receives)
    receivings_.push_back({r.rank, std::as_writable_bytes(std::span(received_).subspan(r.begin, r.end - r.begin))});
}

template <class Value>
void Halo<Value>::exchange(const Value* unknowns) {
  std::size_t at = 0;
  for (const Layer& layer : sent_layers_) {
    const Value* values = unknowns + layout_.offset[layer.brick];
    for_each_in_layer(layout_.extent[layer.brick], layer.side, [&](std::size_t voxel, std::size_t) { sent_[at++] = values[voxel]; });
  }
  comm_.exchange(sendings_, receivings_);
}

template class Halo<double>;
template class Halo<float>;

}  // namespace morula::fields
