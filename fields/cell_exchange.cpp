#include "fields/cell_exchange.h"

#include <algorithm>
#include <cstring>
#include <tuple>

#include "fields/cell_weights.h"

namespace morula::fields {

CellExchange::CellExchange(const Field& field, const Space& space, std::span<const int> owner, std::span<const CellSource> cells,
                           const Comm& comm) {
  const auto ranks = static_cast<std::size_t>(comm.size());
  std::vector<std::vector<VoxelWeight>> weights(cells.size());
#pragma omp parallel for schedule(static) if (cells.size() > 256)
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const CellSource& cell = cells[i];
    if (cell.faces.empty())
      sphere_weights(field.grid, space, cell.center, cell.radius, weights[i]);
    else
      surface_weights(field.grid, space, cell.center, cell.faces, cell.nodes, weights[i]);
  }

  std::vector<std::vector<std::byte>> outgoing(ranks);
  first_sent_.push_back(0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const VoxelWeight& w : weights[i]) {
      const int rank = owner[static_cast<std::size_t>(w.brick)];
      const Deposit deposit{cells[i].id.bits(), w.weight, static_cast<std::int32_t>(w.brick), w.voxel, cells[i].type, 0, 0, 0};
      auto& message = outgoing[static_cast<std::size_t>(rank)];
      const auto at = message.size();
      message.resize(at + sizeof(Deposit));
      std::memcpy(message.data() + at, &deposit, sizeof(Deposit));
      sent_.push_back({rank, w.weight});
    }
    first_sent_.push_back(sent_.size());
  }

  const auto incoming = comm.exchange(outgoing);
  for (std::size_t r = 0; r < ranks; ++r) {
    const std::size_t count = incoming[r].size() / sizeof(Deposit), begin = deposits_.size();
    received_from_.push_back(count);
    deposits_.resize(begin + count);
    if (count > 0) std::memcpy(deposits_.data() + begin, incoming[r].data(), incoming[r].size());
    for (std::size_t i = 0; i < count; ++i) {
      Deposit& d = deposits_[begin + i];
      const auto& bricks = field.owned_bricks;
      d.brick = static_cast<std::int32_t>(std::lower_bound(bricks.begin(), bricks.end(), std::int64_t{d.brick}) - bricks.begin());
      d.from = static_cast<std::int32_t>(r);
      d.place = i;
    }
  }
  std::sort(deposits_.begin(), deposits_.end(), [](const Deposit& a, const Deposit& b) {
    return std::tie(a.brick, a.voxel, a.type, a.id) < std::tie(b.brick, b.voxel, b.type, b.id);
  });
}

std::vector<Sink> CellExchange::sinks(const std::vector<bool>& takes_up) const {
  std::vector<Sink> out;
  for (const Deposit& d : deposits_) {
    if (d.type >= takes_up.size() || !takes_up[d.type]) continue;
    if (out.empty() || out.back().brick != d.brick || out.back().voxel != d.voxel || out.back().type != d.type)
      out.push_back({d.brick, d.voxel, d.type, 0.0});
    out.back().cells += d.weight;
  }
  return out;
}

void CellExchange::give_back(const Field& field, const Layout& layout, std::span<const double> sink_taken, const Comm& comm,
                             std::span<double> taken, std::span<double> seen) const {
  const auto ranks = received_from_.size();
  std::vector<std::vector<Share>> shares(ranks);
  for (std::size_t r = 0; r < ranks; ++r) shares[r].resize(received_from_[r]);
  const auto share_of = [&](const Deposit& d) -> Share& { return shares[static_cast<std::size_t>(d.from)][d.place]; };
  for (const Deposit& d : deposits_)
    share_of(d).concentration = field.concentration[static_cast<std::size_t>(d.brick)][static_cast<std::size_t>(d.voxel)];

  std::size_t at = 0;
  for (std::size_t s = 0; s < layout.sinks.size(); ++s) {
    const Sink& sink = layout.sinks[s];
    const auto key = std::tie(sink.brick, sink.voxel, sink.type);
    while (std::tie(deposits_[at].brick, deposits_[at].voxel, deposits_[at].type) < key) ++at;
    // Shares by weight; the round-off goes to the largest, so that the cells' amounts add up to what the voxel lost.
    const std::size_t begin = at;
    std::size_t largest = at;
    double given = 0.0;
    for (; at < deposits_.size() && std::tie(deposits_[at].brick, deposits_[at].voxel, deposits_[at].type) == key; ++at) {
      share_of(deposits_[at]).taken = sink_taken[s] * (deposits_[at].weight / sink.cells);
      given += share_of(deposits_[at]).taken;
      if (deposits_[at].weight > deposits_[largest].weight) largest = at;
    }
    if (at > begin) share_of(deposits_[largest]).taken += sink_taken[s] - given;
  }

  std::vector<std::vector<std::byte>> outgoing(ranks);
  for (std::size_t r = 0; r < ranks; ++r) {
    const auto bytes = std::as_bytes(std::span(shares[r]));
    outgoing[r].assign(bytes.begin(), bytes.end());
  }
  const auto incoming = comm.exchange(outgoing);
  std::vector<std::size_t> next(ranks, 0);
  for (std::size_t i = 0; i + 1 < first_sent_.size(); ++i) {
    taken[i] = 0.0;
    seen[i] = 0.0;
    for (std::size_t k = first_sent_[i]; k < first_sent_[i + 1]; ++k) {
      const auto r = static_cast<std::size_t>(sent_[k].rank);
      Share share;
      std::memcpy(&share, incoming[r].data() + next[r]++ * sizeof(Share), sizeof(Share));
      taken[i] += share.taken;
      seen[i] += sent_[k].weight * share.concentration;
    }
  }
}

}  // namespace morula::fields
