#include "core/parallel/comm.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <numeric>

namespace morula {
namespace {

constexpr int kMailTag = 71, kKnownTag = 72;

/// Calls part(first, count) for one stretch of at most `most` things after the other.
template <class Part>
void in_parts(std::size_t total, std::size_t most, const Part& part) {
  for (std::size_t at = 0; at < total; at += most) part(at, std::min(most, total - at));
}

std::size_t part_count(std::size_t total, std::size_t most) { return (total + most - 1) / most; }

/// Every element becomes what `operation` makes of it over all ranks.
template <class T>
void reduce(std::span<T> values, MPI_Datatype type, MPI_Op operation, std::size_t largest, MPI_Comm comm) {
  in_parts(values.size(), std::max<std::size_t>(1, largest / sizeof(T)), [&](std::size_t at, std::size_t count) {
    MPI_Allreduce(MPI_IN_PLACE, values.data() + at, static_cast<int>(count), type, operation, comm);
  });
}

}  // namespace

Comm::Comm(MPI_Comm comm, std::size_t largest_message)
    : comm_(comm), largest_(std::clamp<std::size_t>(largest_message, 1, kLargestMessage)) {
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}

double Comm::sum(const OrderFreeSum& local) const {
  double out = 0.0;
  sum(std::span(&local, 1), std::span(&out, 1));
  return out;
}

void Comm::sum(std::span<const OrderFreeSum> local, std::span<double> out) const {
  if (size_ == 1) {
    for (std::size_t i = 0; i < local.size(); ++i) out[i] = local[i].value();
    return;
  }
  std::vector<std::array<std::int64_t, OrderFreeSum::kWords>> words(local.size());
  for (std::size_t i = 0; i < local.size(); ++i) words[i] = local[i].words();
  reduce(std::span(words.data()->data(), words.size() * OrderFreeSum::kWords), MPI_INT64_T, MPI_SUM, largest_, comm_);
  for (std::size_t i = 0; i < local.size(); ++i) out[i] = OrderFreeSum::from_words(words[i]).value();
}

std::int64_t Comm::sum(std::int64_t local) const {
  sum(std::span(&local, 1));
  return local;
}

void Comm::sum(std::span<std::int64_t> values) const {
  if (size_ > 1) reduce(values, MPI_INT64_T, MPI_SUM, largest_, comm_);
}

double Comm::max(double local) const {
  if (size_ > 1) reduce(std::span(&local, 1), MPI_DOUBLE, MPI_MAX, largest_, comm_);
  return local;
}

double Comm::min(double local) const {
  min(std::span(&local, 1));
  return local;
}

void Comm::min(std::span<double> values) const {
  if (size_ > 1) reduce(values, MPI_DOUBLE, MPI_MIN, largest_, comm_);
}

std::int64_t Comm::max(std::int64_t local) const {
  if (size_ > 1) reduce(std::span(&local, 1), MPI_INT64_T, MPI_MAX, largest_, comm_);
  return local;
}

std::int64_t Comm::exclusive_scan(std::int64_t local) const {
  exclusive_scan(std::span(&local, 1));
  return local;
}

void Comm::exclusive_scan(std::span<std::int64_t> values) const {
  if (size_ > 1)
    in_parts(values.size(), std::max<std::size_t>(1, largest_ / sizeof(std::int64_t)), [&](std::size_t at, std::size_t count) {
      MPI_Exscan(MPI_IN_PLACE, values.data() + at, static_cast<int>(count), MPI_INT64_T, MPI_SUM, comm_);
    });
  if (rank_ == 0) std::fill(values.begin(), values.end(), 0);  // MPI leaves them as they were
}

std::vector<std::int64_t> Comm::gather_to_all(std::int64_t local) const {
  if (size_ == 1) return {local};
  std::vector<std::int64_t> out(static_cast<std::size_t>(size_));
  MPI_Allgather(&local, 1, MPI_INT64_T, out.data(), 1, MPI_INT64_T, comm_);
  return out;
}

std::vector<std::byte> Comm::gather_to_all(std::span<const std::byte> local) const {
  if (size_ == 1) return {local.begin(), local.end()};
  const auto sizes = gather_to_all(static_cast<std::int64_t>(local.size()));
  std::vector<std::byte> out(static_cast<std::size_t>(std::accumulate(sizes.begin(), sizes.end(), std::int64_t{0})));
  if (!out.empty()) gather_in_rounds(local, sizes, out);
  return out;
}

void Comm::gather_in_rounds(std::span<const std::byte> local, std::span<const std::int64_t> sizes, std::span<std::byte> out) const {
  const auto longest = static_cast<std::size_t>(*std::max_element(sizes.begin(), sizes.end()));
  const bool one_round = out.size() <= largest_;
  const std::size_t share = one_round ? longest : std::max<std::size_t>(1, largest_ / static_cast<std::size_t>(size_));
  std::vector<int> counts(sizes.size()), offsets(sizes.size());
  std::vector<std::byte> room;
  in_parts(longest, share, [&](std::size_t first, std::size_t) {
    const auto count_of = [&](std::size_t size) { return static_cast<int>(std::min(share, size - std::min(first, size))); };
    for (std::size_t r = 0; r < sizes.size(); ++r) counts[r] = count_of(static_cast<std::size_t>(sizes[r]));
    std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
    if (!one_round) room.resize(static_cast<std::size_t>(offsets.back() + counts.back()));
    std::byte* const received = one_round ? out.data() : room.data();
    MPI_Allgatherv(local.data() + std::min(first, local.size()), count_of(local.size()), MPI_BYTE, received, counts.data(), offsets.data(),
                   MPI_BYTE, comm_);
    if (one_round) return;
    std::size_t begin = first;  // where a rank's bytes of this round belong
    for (std::size_t r = 0; r < sizes.size(); begin += static_cast<std::size_t>(sizes[r++]))
      if (counts[r] > 0) std::copy_n(received + offsets[r], counts[r], out.data() + begin);
  });
}

Mail Comm::exchange(Mail outgoing) const {
  std::erase_if(outgoing, [](const auto& entry) { return entry.second.empty(); });
  Mail incoming;
  if (auto own = outgoing.extract(rank_)) incoming.insert(std::move(own));
  if (size_ == 1) return incoming;
  std::vector<std::int64_t> parts(static_cast<std::size_t>(size_), 0);
  for (const auto& [rank, bytes] : outgoing)
    parts[static_cast<std::size_t>(rank)] = static_cast<std::int64_t>(part_count(bytes.size(), largest_));
  std::int64_t coming = 0;
  // Nobody comes out of this before all have come in, and so have received all mail of an earlier exchange: the two cannot be mixed up.
  MPI_Reduce_scatter_block(parts.data(), &coming, 1, MPI_INT64_T, MPI_SUM, comm_);
  std::vector<MPI_Request> requests;
  for (const auto& [to, bytes] : outgoing)
    in_parts(bytes.size(), largest_, [&, rank = to, from = bytes.data()](std::size_t at, std::size_t count) {
      MPI_Isend(from + at, static_cast<int>(count), MPI_BYTE, rank, kMailTag, comm_, &requests.emplace_back());
    });
  for (; coming > 0; --coming) {  // whoever comes first; the parts of one sender come in order
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status;
    MPI_Mprobe(MPI_ANY_SOURCE, kMailTag, comm_, &message, &status);
    int count = 0;
    MPI_Get_count(&status, MPI_BYTE, &count);
    std::vector<std::byte>& mail = incoming[status.MPI_SOURCE];
    const std::size_t old = mail.size();
    mail.resize(old + static_cast<std::size_t>(count));
    MPI_Mrecv(mail.data() + old, count, MPI_BYTE, &message, MPI_STATUS_IGNORE);
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return incoming;
}

void Comm::exchange(std::span<const Sending> sendings, std::span<const Receiving> receivings) const {
  std::vector<MPI_Request> requests;
  requests.reserve(sendings.size() + receivings.size());
  for (const Receiving& from : receivings) {
    assert(from.rank != rank_);
    in_parts(from.bytes.size(), largest_, [&](std::size_t at, std::size_t count) {
      MPI_Irecv(from.bytes.data() + at, static_cast<int>(count), MPI_BYTE, from.rank, kKnownTag, comm_, &requests.emplace_back());
    });
  }
  for (const Sending& to : sendings) {
    assert(to.rank != rank_);
    in_parts(to.bytes.size(), largest_, [&](std::size_t at, std::size_t count) {
      MPI_Isend(to.bytes.data() + at, static_cast<int>(count), MPI_BYTE, to.rank, kKnownTag, comm_, &requests.emplace_back());
    });
  }
  if (!requests.empty()) MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

void Comm::broadcast(std::vector<std::byte>& bytes, int from) const {
  if (size_ == 1) return;
  auto size = static_cast<std::int64_t>(bytes.size());
  MPI_Bcast(&size, 1, MPI_INT64_T, from, comm_);
  bytes.resize(static_cast<std::size_t>(size));
  in_parts(bytes.size(), largest_,
           [&](std::size_t at, std::size_t count) { MPI_Bcast(bytes.data() + at, static_cast<int>(count), MPI_BYTE, from, comm_); });
}

void Comm::barrier() const {
  if (size_ > 1) MPI_Barrier(comm_);
}

}  // namespace morula
