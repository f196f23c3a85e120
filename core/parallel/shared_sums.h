#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/parallel/comm.h"

namespace morula {

/// Exact sums by key over ranks each of which knows some of the keys, and none of which knows who else does.
///
/// A key that a few ranks have is added up at its home, a rank that follows from the key alone, and the total goes back to them. The few keys
/// that many ranks have (a cluster that goes through the whole tissue) are added up by a reduction over all ranks instead, so that no home has
/// many guests. What a rank sends and receives grows with its own keys, not with the number of ranks.
class SharedSums {
 public:
  /// Four boxes of a division by cuts in turn meet in a point: what is small is on no more ranks.
  static constexpr int kFewRanks = 4;

  /// Find out how often each key occurs. `keys`: those of this rank, increasing, each once. Collective.
  void find(std::vector<std::uint64_t> keys, const Comm& comm, int few_ranks = kFewRanks);

  /// The keys of this rank.
  [[nodiscard]] std::span<const std::uint64_t> keys() const { return keys_; }

  /// Totals over all ranks of `terms` sums for each key of this rank, key after key, as `local` is. The same bits on any number of ranks.
  /// Collective.
  [[nodiscard]] std::vector<double> totals(std::span<const OrderFreeSum> local, std::size_t terms, const Comm& comm) const;

  [[nodiscard]] std::size_t memory() const;

 private:
  using Places = std::vector<std::size_t>;

  /// Totals of the keys that many ranks have, into `out`.
  void add_wide(std::span<const OrderFreeSum> local, std::size_t terms, const Comm& comm, std::span<double> out) const;

  std::vector<std::uint64_t> keys_;
  std::vector<std::uint64_t> wide_;  ///< keys that many ranks have, increasing. All ranks hold equal copies.
  Places wide_places_;               ///< of keys_ in wide_; keys_.size() entries, wide_.size() where a key is not wide
  std::map<int, Places> at_;         ///< by home: places in keys_ of those that are added up there
  std::map<int, Places> guests_;     ///< by rank that has keys whose home this is: their places among all such keys
  std::size_t housed_ = 0;           ///< number of keys whose home this is
};

}  // namespace morula
