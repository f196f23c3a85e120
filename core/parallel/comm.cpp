#include "core/parallel/comm.h"

#include <numeric>

namespace morula {

Comm::Comm(MPI_Comm comm) : comm_(comm) {
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
  MPI_Allreduce(MPI_IN_PLACE, words.data(), static_cast<int>(words.size() * OrderFreeSum::kWords), MPI_INT64_T, MPI_SUM, comm_);
  for (std::size_t i = 0; i < local.size(); ++i) out[i] = OrderFreeSum::from_words(words[i]).value();
}

std::int64_t Comm::sum(std::int64_t local) const {
  if (size_ == 1) return local;
  MPI_Allreduce(MPI_IN_PLACE, &local, 1, MPI_INT64_T, MPI_SUM, comm_);
  return local;
}

double Comm::max(double local) const {
  if (size_ == 1) return local;
  MPI_Allreduce(MPI_IN_PLACE, &local, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return local;
}

double Comm::min(double local) const {
  if (size_ == 1) return local;
  MPI_Allreduce(MPI_IN_PLACE, &local, 1, MPI_DOUBLE, MPI_MIN, comm_);
  return local;
}

std::int64_t Comm::max(std::int64_t local) const {
  if (size_ == 1) return local;
  MPI_Allreduce(MPI_IN_PLACE, &local, 1, MPI_INT64_T, MPI_MAX, comm_);
  return local;
}

std::int64_t Comm::exclusive_scan(std::int64_t local) const {
  if (size_ == 1) return 0;
  std::int64_t out = 0;
  MPI_Exscan(&local, &out, 1, MPI_INT64_T, MPI_SUM, comm_);
  return rank_ == 0 ? 0 : out;
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
  std::vector<int> counts(sizes.begin(), sizes.end());
  std::vector<int> offsets(counts.size(), 0);
  std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
  std::vector<std::byte> out(static_cast<std::size_t>(std::accumulate(sizes.begin(), sizes.end(), std::int64_t{0})));
  MPI_Allgatherv(local.data(), static_cast<int>(local.size()), MPI_BYTE, out.data(), counts.data(), offsets.data(), MPI_BYTE, comm_);
  return out;
}

std::vector<std::vector<std::byte>> Comm::exchange(const std::vector<std::vector<std::byte>>& outgoing) const {
  if (size_ == 1) return outgoing;
  const auto ranks = static_cast<std::size_t>(size_);
  std::vector<std::int64_t> send_sizes(ranks), receive_sizes(ranks);
  for (std::size_t r = 0; r < ranks; ++r) send_sizes[r] = static_cast<std::int64_t>(outgoing[r].size());
  MPI_Alltoall(send_sizes.data(), 1, MPI_INT64_T, receive_sizes.data(), 1, MPI_INT64_T, comm_);
  std::vector<std::vector<std::byte>> incoming(ranks);
  std::vector<MPI_Request> requests;
  for (std::size_t r = 0; r < ranks; ++r) {
    incoming[r].resize(static_cast<std::size_t>(receive_sizes[r]));
    if (!incoming[r].empty())
      MPI_Irecv(incoming[r].data(), static_cast<int>(incoming[r].size()), MPI_BYTE, static_cast<int>(r), 71, comm_,
                &requests.emplace_back());
  }
  for (std::size_t r = 0; r < ranks; ++r)
    if (!outgoing[r].empty())
      MPI_Isend(outgoing[r].data(), static_cast<int>(outgoing[r].size()), MPI_BYTE, static_cast<int>(r), 71, comm_,
                &requests.emplace_back());
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return incoming;
}

void Comm::broadcast(std::vector<std::byte>& bytes) const {
  if (size_ == 1) return;
  auto size = static_cast<std::int64_t>(bytes.size());
  MPI_Bcast(&size, 1, MPI_INT64_T, 0, comm_);
  bytes.resize(static_cast<std::size_t>(size));
  MPI_Bcast(bytes.data(), static_cast<int>(size), MPI_BYTE, 0, comm_);
}

void Comm::barrier() const {
  if (size_ > 1) MPI_Barrier(comm_);
}

}  // namespace morula
