#include "fields/cell_exchange.h"

#include <algorithm>
#include <cstring>
#include <map>
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

  std::vector<std::vector<std::byte>> messages;  // by host
  std::map<int, std::uint32_t> host_of;          // by rank
  first_sent_.push_back(0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const VoxelWeight& w : weights[i]) {
      const auto [host, is_new] =
          host_of.try_emplace(field.owner[static_cast<std::size_t>(w.brick)], static_cast<std::uint32_t>(hosts_.size()));
      if (is_new) {
        hosts_.push_back({host->first, 0});
        messages.emplace_back();
      }
      const Deposit deposit{cells[i].id.bits(), w.weight, static_cast<std::int32_t>(w.brick), w.voxel, cells[i].type, 0, 0, 0};
      const auto bytes = std::as_bytes(std::span(&deposit, 1));
      messages[host->second].insert(messages[host->second].end(), bytes.begin(), bytes.end());
      ++hosts_[host->second].deposits;
      sent_.push_back({host->second, w.weight});
    }
    first_sent_.push_back(sent_.size());
  }

  Mail outgoing;
  for (const auto& [rank, host] : host_of) outgoing[rank] = std::move(messages[host]);
  for (const auto& [rank, bytes] : comm.exchange(std::move(outgoing))) {
    const std::size_t count = bytes.size() / sizeof(Deposit), begin = deposits_.size();
    deposits_.resize(begin + count);
    std::memcpy(deposits_.data() + begin, bytes.data(), bytes.size());
    for (std::size_t i = 0; i < count; ++i) {
      Deposit& d = deposits_[begin + i];
      const auto& bricks = field.owned_bricks;
      d.brick = static_cast<std::int32_t>(std::lower_bound(bricks.begin(), bricks.end(), std::int64_t{d.brick}) - bricks.begin());
      d.from = static_cast<std::uint32_t>(guests_.size());
      d.place = i;
    }
    guests_.push_back({rank, count});
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
