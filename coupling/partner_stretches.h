#pragma once
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "cbm/partners.h"

namespace morula {

/// Partner lists that are put together from stretches of others: what stays is copied in one piece.
class PartnerStretches {
 public:
  void reserve(std::size_t lists, std::size_t partners) { end_.reserve(lists), ids_.reserve(partners); }
  /// The lists first, …, last − 1 of `from` behind the others.
  void add(const cbm::PartnerLists& from, std::size_t first, std::size_t last) {
    if (first == last) return;
    const CellId* const begin = from[first].data();
    const auto shift = static_cast<std::ptrdiff_t>(ids_.size());
    for (std::size_t i = first; i < last; ++i)
      end_.push_back(static_cast<std::uint32_t>(shift + (from[i].data() + from[i].size() - begin)));
    ids_.insert(ids_.end(), begin, from[last - 1].data() + from[last - 1].size());
  }
  /// One more list, sorted.
  void add(std::span<const CellId> partners) {
    ids_.insert(ids_.end(), partners.begin(), partners.end());
    end_.push_back(static_cast<std::uint32_t>(ids_.size()));
  }
  [[nodiscard]] cbm::PartnerLists take() && { return {std::move(ids_), std::move(end_)}; }

 private:
  std::vector<CellId> ids_;
  std::vector<std::uint32_t> end_;
};

}  // namespace morula
