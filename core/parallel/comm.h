#pragma once
#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/parallel/order_free_sum.h"

namespace morula {

/// Bytes by rank: where they go, or where they came from. It holds only ranks that there is something for.
using Mail = std::map<int, std::vector<std::byte>>;

/// A message to another rank, which knows how long it is.
struct Sending {
  int rank = 0;
  std::span<const std::byte> bytes;
};
/// Room for a message of another rank, of just its length.
struct Receiving {
  int rank = 0;
  std::span<std::byte> bytes;
};

/// The ranks that share a tissue. A thin, explicit wrapper of an MPI communicator: it is passed in, never global.
///
/// Sums are order-free, so that every rank gets the same bits whatever the number of ranks. MPI counts in 32 bits: what is longer than
/// `largest_message` goes in several messages, so that no length is too large (decision 0037).
class Comm {
 public:
  static constexpr std::size_t kLargestMessage = std::size_t{1} << 30;  ///< [bytes]

  /// One rank alone; works without MPI being initialised.
  Comm() = default;
  explicit Comm(MPI_Comm comm, std::size_t largest_message = kLargestMessage);

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] bool is_root() const { return rank_ == 0; }
  [[nodiscard]] MPI_Comm raw() const { return comm_; }

  /// Exact sum over all ranks, the same bits everywhere.
  [[nodiscard]] double sum(const OrderFreeSum& local) const;
  /// Several exact sums in one message; out[i] belongs to local[i].
  void sum(std::span<const OrderFreeSum> local, std::span<double> out) const;
  [[nodiscard]] std::int64_t sum(std::int64_t local) const;
  /// Each value becomes its sum over all ranks.
  void sum(std::span<std::int64_t> values) const;
  [[nodiscard]] double max(double local) const;
  [[nodiscard]] double min(double local) const;
  /// Each value becomes the least of all ranks.
  void min(std::span<double> values) const;
  [[nodiscard]] std::int64_t max(std::int64_t local) const;
  [[nodiscard]] bool any(bool local) const { return max(std::int64_t{local}) != 0; }
  [[nodiscard]] bool all(bool local) const { return !any(!local); }
  /// Sum of the values of the ranks before this one (0 on rank 0).
  [[nodiscard]] std::int64_t exclusive_scan(std::int64_t local) const;
  /// Each value becomes its sum over the ranks before this one.
  void exclusive_scan(std::span<std::int64_t> values) const;
  /// One value of each rank, in rank order.
  [[nodiscard]] std::vector<std::int64_t> gather_to_all(std::int64_t local) const;
  /// Bytes of all ranks, concatenated in rank order. For a few bytes of each rank: every rank receives all of them.
  [[nodiscard]] std::vector<std::byte> gather_to_all(std::span<const std::byte> local) const;
  /// Mail to ranks that do not know of it; gives what has come for this rank, by sender. Beside the mail itself every rank learns, in one
  /// reduction of a count per rank, how many messages are on their way to it. Collective.
  [[nodiscard]] Mail exchange(Mail outgoing) const;
  /// Messages between ranks that know of each other: one for each sending, no collective. Two of the same ranks arrive in the order in
  /// which they are listed, and their lengths are the same on both sides. None may be to this rank itself.
  void exchange(std::span<const Sending> sendings, std::span<const Receiving> receivings) const;
  /// The bytes of a rank on every rank.
  void broadcast(std::vector<std::byte>& bytes, int from = 0) const;
  void barrier() const;

 private:
  /// gather_to_all() in as many rounds as the length of messages asks for; `sizes` are those of all ranks.
  void gather_in_rounds(std::span<const std::byte> local, std::span<const std::int64_t> sizes, std::span<std::byte> out) const;

  MPI_Comm comm_ = MPI_COMM_NULL;
  std::size_t largest_ = kLargestMessage;
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace morula
