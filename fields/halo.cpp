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

constexpr int kHaloTag = 72;

}  // namespace

Halo::Halo(const Field& field, const Layout& layout, const Space& space, std::span<const int> owner, const Comm& comm)
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
      const int rank = owner[static_cast<std::size_t>(other)];
      if (rank == comm.rank()) {
        sources_[b][side] = {GhostSource::Kind::kSameRank, local(other)};
        continue;
      }
      to_receive[rank][{bricks[b], side}] = {b, side};
      to_send[rank][{other, side ^ 1u}] = {b, side};
    }
  }
  for (const auto& [rank, layers] : to_receive) {
    const std::size_t begin = received_.size();
    for (const auto& [wanted, layer] : layers) {
      sources_[layer.brick][layer.side] = {GhostSource::Kind::kOtherRank, received_.size()};
      received_.resize(received_.size() + layer_size(layout.extent[layer.brick], layer.side));
    }
    receives_.push_back({rank, begin, received_.size()});
  }
  for (const auto& [rank, layers] : to_send) {
    const std::size_t begin = sent_.size();
    for (const auto& [wanted, layer] : layers) {
      sent_layers_.push_back(layer);
      sent_.resize(sent_.size() + layer_size(layout.extent[layer.brick], layer.side));
    }
    sends_.push_back({rank, begin, sent_.size()});
  }
}

void Halo::exchange(const double* unknowns) {
  if (sends_.empty() && receives_.empty()) return;
  std::vector<MPI_Request> requests;
  requests.reserve(sends_.size() + receives_.size());
  for (const Message& m : receives_)
    MPI_Irecv(received_.data() + m.begin, static_cast<int>(m.end - m.begin), MPI_DOUBLE, m.rank, kHaloTag, comm_.raw(),
              &requests.emplace_back());
  std::size_t at = 0;
  for (const Layer& layer : sent_layers_) {
    const double* values = unknowns + layout_.offset[layer.brick];
    for_each_in_layer(layout_.extent[layer.brick], layer.side, [&](std::size_t voxel, std::size_t) { sent_[at++] = values[voxel]; });
  }
  for (const Message& m : sends_)
    MPI_Isend(sent_.data() + m.begin, static_cast<int>(m.end - m.begin), MPI_DOUBLE, m.rank, kHaloTag, comm_.raw(),
              &requests.emplace_back());
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

}  // namespace morula::fields
