#include "core/parallel/shared_sums.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace morula {
namespace {

using Words = std::array<std::int64_t, OrderFreeSum::kWords>;

/// The finalizer of SplitMix64 (Steele, Lea & Flood 2014, doi:10.1145/2660193.2660195): keys that follow each other come to different ranks.
int home_of(std::uint64_t key, int ranks) {
  key = (key ^ (key >> 30)) * 0xBF58476D1CE4E5B9u;
  key = (key ^ (key >> 27)) * 0x94D049BB133111EBu;
  return static_cast<int>((key ^ (key >> 31)) % static_cast<std::uint64_t>(ranks));
}

std::vector<std::uint64_t> keys_in(std::span<const std::byte> bytes) {
  std::vector<std::uint64_t> out(bytes.size() / sizeof(std::uint64_t));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

std::size_t place_of(std::uint64_t key, std::span<const std::uint64_t> sorted) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), key);
  return static_cast<std::size_t>((at != sorted.end() && *at == key ? at : sorted.end()) - sorted.begin());
}

using Places = std::vector<std::size_t>;
using Messages = std::map<int, std::vector<std::byte>>;

/// Room for the messages to or from the ranks of a list: `terms` values for each of its places.
template <class T>
Messages rooms(const std::map<int, Places>& ranks, std::size_t terms) {
  Messages out;
  for (const auto& [rank, places] : ranks) out[rank].resize(places.size() * terms * sizeof(T));
  return out;
}

/// Calls with(value, place in the list of sums) for all values of all messages; the value is kept in the message.
template <class T, class F>
void for_values(Messages& messages, const std::map<int, Places>& ranks, std::size_t terms, const F& with) {
  for (auto& [rank, bytes] : messages) {
    std::byte* next = bytes.data();
    for (const std::size_t place : ranks.at(rank))
      for (std::size_t t = 0; t < terms; ++t, next += sizeof(T)) {
        T value;
        std::memcpy(&value, next, sizeof value);
        with(value, place * terms + t);
        std::memcpy(next, &value, sizeof value);
      }
  }
}

/// All ranks know how long the messages are. One to this rank itself is no message.
void swap_messages(const Messages& out, Messages& in, const Comm& comm) {
  std::vector<Sending> sendings;
  std::vector<Receiving> receivings;
  for (const auto& [rank, bytes] : out)
    if (rank != comm.rank()) sendings.push_back({rank, bytes});
  for (auto& [rank, bytes] : in) {
    if (rank == comm.rank())
      bytes = out.at(rank);
    else
      receivings.push_back({rank, bytes});
  }
  comm.exchange(sendings, receivings);
}

}  // namespace

void SharedSums::find(std::vector<std::uint64_t> keys, const Comm& comm, int few_ranks) {
  keys_ = std::move(keys);
  at_.clear();
  guests_.clear();
  Mail questions;
  for (const std::uint64_t key : keys_) {
    const auto bytes = std::as_bytes(std::span(&key, 1));
    std::vector<std::byte>& message = questions[home_of(key, comm.size())];
    message.insert(message.end(), bytes.begin(), bytes.end());
  }
  std::map<int, std::vector<std::uint64_t>> asked;
  std::map<std::uint64_t, int> ranks_with;
  for (const auto& [rank, bytes] : comm.exchange(std::move(questions)))
    for (const std::uint64_t key : asked[rank] = keys_in(bytes)) ++ranks_with[key];
  std::vector<std::uint64_t> wide, housed;
  for (const auto& [key, ranks] : ranks_with) (ranks > few_ranks ? wide : housed).push_back(key);
  wide_ = keys_in(comm.gather_to_all(std::as_bytes(std::span(wide))));
  std::sort(wide_.begin(), wide_.end());
  housed_ = housed.size();
  for (const auto& [rank, list] : asked)
    for (const std::uint64_t key : list)
      if (const std::size_t place = place_of(key, housed); place < housed.size()) guests_[rank].push_back(place);
  wide_places_.clear();
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    wide_places_.push_back(place_of(keys_[k], wide_));
    if (wide_places_.back() == wide_.size()) at_[home_of(keys_[k], comm.size())].push_back(k);
  }
}

void SharedSums::add_wide(std::span<const OrderFreeSum> local, std::size_t terms, const Comm& comm, std::span<double> out) const {
  if (wide_.empty()) return;
  std::vector<OrderFreeSum> sums(wide_.size() * terms);
  std::vector<double> total(sums.size());
  const auto for_mine = [&](const auto& with) {
    for (std::size_t k = 0; k < keys_.size(); ++k)
      for (std::size_t t = 0; t < terms && wide_places_[k] < wide_.size(); ++t) with(k * terms + t, wide_places_[k] * terms + t);
  };
  for_mine([&](std::size_t here, std::size_t there) { sums[there] = local[here]; });
  comm.sum(sums, total);
  for_mine([&](std::size_t here, std::size_t there) { out[here] = total[there]; });
}

std::vector<double> SharedSums::totals(std::span<const OrderFreeSum> local, std::size_t terms, const Comm& comm) const {
  std::vector<double> out(keys_.size() * terms);
  add_wide(local, terms, comm, out);

  Messages parts = rooms<Words>(at_, terms), guests = rooms<Words>(guests_, terms);
  for_values<Words>(parts, at_, terms, [&](Words& words, std::size_t i) { words = local[i].words(); });
  swap_messages(parts, guests, comm);
  std::vector<OrderFreeSum> sums(housed_ * terms);
  for_values<Words>(guests, guests_, terms, [&](const Words& words, std::size_t i) { sums[i] += OrderFreeSum::from_words(words); });

  Messages answers = rooms<double>(guests_, terms), totals = rooms<double>(at_, terms);
  for_values<double>(answers, guests_, terms, [&](double& value, std::size_t i) { value = sums[i].value(); });
  swap_messages(answers, totals, comm);
  for_values<double>(totals, at_, terms, [&](double value, std::size_t i) { out[i] = value; });
  return out;
}

std::size_t SharedSums::memory() const {
  std::size_t total =
      keys_.capacity() * sizeof keys_[0] + wide_.capacity() * sizeof wide_[0] + wide_places_.capacity() * sizeof(std::size_t);
  for (const auto* lists : {&at_, &guests_})
    for (const auto& [rank, places] : *lists) total += places.capacity() * sizeof(std::size_t);
  return total;
}

}  // namespace morula
