#pragma once
#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel/order_free_sum.h"

namespace morula {

/// The ranks that share a tissue. A thin, explicit wrapper of an MPI communicator: it is passed in, never global.
///
/// Sums are order-free, so that every rank gets the same bits whatever the number of ranks.
class Comm {
 public:
  /// One rank alone; works without MPI being initialised.
  Comm() = default;
  explicit Comm(MPI_Comm comm);

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] bool is_root() const { return rank_ == 0; }
  [[nodiscard]] MPI_Comm raw() const { return comm_; }

  /// Exact sum over all ranks, the same bits everywhere.
  [[nodiscard]] double sum(const OrderFreeSum& local) const;
  /// Several exact sums in one message; out[i] belongs to local[i].
  void sum(std::span<const OrderFreeSum> local, std::span<double> out) const;
  [[nodiscard]] std::int64_t sum(std::int64_t local) const;
  [[nodiscard]] double max(double local) const;
  [[nodiscard]] double min(double local) const;
  [[nodiscard]] std::int64_t max(std::int64_t local) const;
  [[nodiscard]] bool any(bool local) const { return max(std::int64_t{local}) != 0; }
  [[nodiscard]] bool all(bool local) const { return !any(!local); }
  /// Sum of the values of the ranks before this one (0 on rank 0).
  [[nodiscard]] std::int64_t exclusive_scan(std::int64_t local) const;
  /// One value of each rank, in rank order.
  [[nodiscard]] std::vector<std::int64_t> gather_to_all(std::int64_t local) const;
  /// Bytes of all ranks, concatenated in rank order.
  [[nodiscard]] std::vector<std::byte> gather_to_all(std::span<const std::byte> local) const;
  /// Send outgoing[r] to rank r; the result's [r] came from rank r.
  [[nodiscard]] std::vector<std::vector<std::byte>> exchange(const std::vector<std::vector<std::byte>>& outgoing) const;
  /// The bytes of the root on every rank.
  void broadcast(std::vector<std::byte>& bytes) const;
  void barrier() const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace morula
