#include "results/parcels.h"

#include <algorithm>
#include <numeric>

namespace morula::scenarios {
namespace {

constexpr std::size_t kSamplesPerRank = 64;

std::vector<std::size_t> order_by_key(const Parcels& parcels) {
  std::vector<std::size_t> order(parcels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return parcels.key(a) < parcels.key(b); });
  return order;
}

/// Keys that cut the parcels of all ranks into one stretch a rank of about equal numbers.
std::vector<std::uint64_t> splitters(const Parcels& local, const std::vector<std::size_t>& order, const Comm& comm) {
  std::vector<std::uint64_t> samples;
  const std::size_t wanted = std::min(kSamplesPerRank, order.size());
  for (std::size_t s = 0; s < wanted; ++s) samples.push_back(local.key(order[s * order.size() / wanted]));
  const std::vector<std::byte> gathered = comm.gather_to_all(std::as_bytes(std::span(samples)));
  std::vector<std::uint64_t> all(gathered.size() / sizeof(std::uint64_t));
  if (!all.empty()) std::memcpy(all.data(), gathered.data(), gathered.size());
  std::sort(all.begin(), all.end());
  std::vector<std::uint64_t> cuts;
  const auto ranks = static_cast<std::size_t>(comm.size());
  for (std::size_t r = 1; r < ranks; ++r) cuts.push_back(all.empty() ? 0 : all[r * all.size() / ranks]);
  return cuts;
}

}  // namespace

Parcels sort_over_ranks(const Parcels& local, const Comm& comm) {
  const std::vector<std::size_t> order = order_by_key(local);
  Parcels mine;
  if (comm.size() == 1) {
    for (const std::size_t i : order) mine.add(local.key(i), local.bytes(i));
    return mine;
  }
  const std::vector<std::uint64_t> cuts = splitters(local, order, comm);
  Mail outgoing;
  ByteWriter parcel;
  for (const std::size_t i : order) {
    const auto target = static_cast<int>(std::upper_bound(cuts.begin(), cuts.end(), local.key(i)) - cuts.begin());
    parcel.clear();
    parcel.put(local.key(i));
    parcel.put(std::uint64_t{local.bytes(i).size()});
    parcel.put_all(local.bytes(i));
    outgoing[target].insert(outgoing[target].end(), parcel.bytes().begin(), parcel.bytes().end());
  }
  Parcels received;
  for (const auto& [rank, message] : comm.exchange(std::move(outgoing))) {
    std::span<const std::byte> rest(message);
    while (!rest.empty()) {
      ByteReader reader(rest);
      const auto key = reader.get<std::uint64_t>();
      const auto size = reader.get<std::uint64_t>();
      received.add(key, rest.subspan(16, size));
      rest = rest.subspan(16 + size);
    }
  }
  for (const std::size_t i : order_by_key(received)) mine.add(received.key(i), received.bytes(i));
  return mine;
}

}  // namespace morula::scenarios
