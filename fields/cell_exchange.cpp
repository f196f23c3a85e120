#include "fields/cell_exchange.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <tuple>

#include "fields/cell_weights.h"

namespace morula::fields {

CellExchange::CellExchange(const Field& field, const Space& space, std::span<const CellSource> cells, const Comm& comm) {
  std::vector<std::vector<VoxelWeight>> weights(cells.size());
#pragma omp parallel for schedule(static) if (cells.size() > 256)
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const CellSource& cell = cells[i];
    if (cell.faces.empty())
      sphere_weights(field.grid, space, cell.center, cell.radius, weights[i]);
    else
      surface_weights(field.grid, space, cell.center, cell.faces, cell.nodes, weights[i]);
  }
  std::vector<std::vector<Deposit>> for_hosts = deposits_for_hosts(field, cells, weights);

  Mail outgoing;
  for (std::size_t h = 0; h < hosts_.size(); ++h) {
    if (hosts_[h].rank == comm.rank()) continue;
    const auto bytes = std::as_bytes(std::span(for_hosts[h]));
    outgoing[hosts_[h].rank].assign(bytes.begin(), bytes.end());
  }
  const auto take_in = [&](int rank, std::span<const Deposit> from) {
    const std::size_t begin = deposits_.size();
    deposits_.insert(deposits_.end(), from.begin(), from.end());
    for (std::size_t i = 0; i < from.size(); ++i) {
      Deposit& d = deposits_[begin + i];
      d.from = static_cast<std::uint32_t>(guests_.size());
      d.place = i;
    }
    guests_.push_back({rank, from.size()});
  };
  for (std::size_t h = 0; h < hosts_.size(); ++h)
    if (hosts_[h].rank == comm.rank()) take_in(comm.rank(), for_hosts[h]);
  for (const auto& [rank, bytes] : comm.exchange(std::move(outgoing))) {
    std::vector<Deposit> from(bytes.size() / sizeof(Deposit));
    std::memcpy(from.data(), bytes.data(), bytes.size());
    take_in(rank, from);
  }
  sort_deposits(field);
}

std::vector<std::vector<CellExchange::Deposit>> CellExchange::deposits_for_hosts(const Field& field, std::span<const CellSource> cells,
                                                                                 std::span<const std::vector<VoxelWeight>> weights) {
  std::vector<std::vector<Deposit>> for_hosts;
  std::map<int, std::uint32_t> host_of;  // by rank
  int last_rank = -1;                    // most neighbours in the list have the same host
  std::uint32_t host = 0;
  first_sent_.push_back(0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const VoxelWeight& w : weights[i]) {
      if (const int rank = field.owner[static_cast<std::size_t>(w.brick)]; rank != last_rank) {
        const auto [known, is_new] = host_of.try_emplace(rank, static_cast<std::uint32_t>(hosts_.size()));
        if (is_new) {
          hosts_.push_back({rank, 0});
          for_hosts.emplace_back();
        }
        last_rank = rank;
        host = known->second;
      }
      for_hosts[host].push_back({cells[i].id.bits(), w.weight, static_cast<std::int32_t>(w.brick), w.voxel, cells[i].type, 0, 0, 0});
      sent_.push_back({host, w.weight});
    }
    first_sent_.push_back(sent_.size());
  }
  for (std::size_t h = 0; h < hosts_.size(); ++h) hosts_[h].deposits = for_hosts[h].size();
  return for_hosts;
}

void CellExchange::sort_deposits(const Field& field) {
  constexpr std::size_t kVoxels = std::size_t{Grid::kBrick} * Grid::kBrick * Grid::kBrick;
  // Into the voxels by counting, then the few of each voxel.
  std::vector<std::int32_t> brick_here(field.owner.size(), -1);
  for (std::size_t b = 0; b < field.owned_bricks.size(); ++b)
    brick_here[static_cast<std::size_t>(field.owned_bricks[b])] = static_cast<std::int32_t>(b);
  std::vector<std::uint32_t> first(field.owned_bricks.size() * kVoxels + 1, 0);
  const auto voxel_of = [](const Deposit& d) { return static_cast<std::size_t>(d.brick) * kVoxels + static_cast<std::size_t>(d.voxel); };
  for (Deposit& d : deposits_) {
    d.brick = brick_here[static_cast<std::size_t>(d.brick)];
    ++first[voxel_of(d) + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Deposit> sorted(deposits_.size());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (const Deposit& d : deposits_) sorted[next[voxel_of(d)]++] = d;
  deposits_ = std::move(sorted);
  for (std::size_t v = 0; v + 1 < first.size(); ++v)
    if (first[v + 1] - first[v] > 1)
      std::sort(deposits_.begin() + first[v], deposits_.begin() + first[v + 1],
                [](const Deposit& a, const Deposit& b) { return std::tie(a.type, a.id) < std::tie(b.type, b.id); });
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
  std::vector<std::vector<Share>> shares(guests_.size());
  for (std::size_t g = 0; g < guests_.size(); ++g) shares[g].resize(guests_[g].deposits);
  const auto share_of = [&](const Deposit& d) -> Share& { return shares[d.from][d.place]; };
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

  const std::vector<std::vector<Share>> answers = swap_shares(std::move(shares), comm);
  std::vector<std::size_t> next(hosts_.size(), 0);
  for (std::size_t i = 0; i + 1 < first_sent_.size(); ++i) {
    taken[i] = 0.0;
    seen[i] = 0.0;
    for (std::size_t k = first_sent_[i]; k < first_sent_[i + 1]; ++k) {
      const Share& share = answers[sent_[k].host][next[sent_[k].host]++];
      taken[i] += share.taken;
      seen[i] += sent_[k].weight * share.concentration;
    }
  }
}

std::vector<std::vector<CellExchange::Share>> CellExchange::swap_shares(std::vector<std::vector<Share>> of_guests, const Comm& comm) const {
  std::vector<std::vector<Share>> of_hosts(hosts_.size());
  std::vector<Sending> sendings;
  std::vector<Receiving> receivings;
  for (std::size_t h = 0; h < hosts_.size(); ++h) {
    of_hosts[h].resize(hosts_[h].deposits);
    if (hosts_[h].rank != comm.rank()) receivings.push_back({hosts_[h].rank, std::as_writable_bytes(std::span(of_hosts[h]))});
  }
  for (std::size_t g = 0; g < guests_.size(); ++g) {
    if (guests_[g].rank != comm.rank()) {
      sendings.push_back({guests_[g].rank, std::as_bytes(std::span(of_guests[g]))});
      continue;
    }
    const auto own = std::find_if(hosts_.begin(), hosts_.end(), [&](const Partner& host) { return host.rank == comm.rank(); });
    of_hosts[static_cast<std::size_t>(own - hosts_.begin())] = std::move(of_guests[g]);
  }
  comm.exchange(sendings, receivings);
  return of_hosts;
}

}  // namespace morula::fields
