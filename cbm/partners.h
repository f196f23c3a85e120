#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/cell_id.h"

namespace morula::cbm {

/// The cells to which a sphere adheres: sorted by id, each once (Spheres::attached). Both partners of a pair carry the entry.
using Partners = std::vector<CellId>;

[[nodiscard]] bool adheres(std::span<const CellId> partners, CellId other);

/// Make or break the entry of one partner; no change where it is so already.
void set_adheres(Partners& partners, CellId other, bool attached);

/// Partners of a daughter at birth: those of its mother and its sister. A neighbour out of reach is let go by the next update_attached, and
/// one within reach does not feel a jump from adhesion to none and back.
[[nodiscard]] Partners daughter_partners(const Partners& mother_partners, CellId sister);

/// In a neighbour of a mother that divides: both daughters in place of her, where she was a partner.
void replace_partner(Partners& partners, CellId mother, CellId first, CellId second);

/// The partners of all spheres of a rank, one list behind the other.
class PartnerLists {
 public:
  PartnerLists() = default;
  /// The lists of spheres 0, 1, …, sorted, one behind the other, and where each ends.
  PartnerLists(std::vector<CellId> ids, std::vector<std::uint32_t> end) : ids_(std::move(ids)), end_(std::move(end)) {}

  [[nodiscard]] std::size_t size() const { return end_.size(); }
  [[nodiscard]] std::span<const CellId> operator[](std::size_t sphere) const {
    return std::span(ids_).subspan(begin(sphere), end_[sphere] - begin(sphere));
  }
  /// The partners of the next sphere, sorted.
  void push_back(std::span<const CellId> partners) {
    ids_.insert(ids_.end(), partners.begin(), partners.end());
    end_.push_back(static_cast<std::uint32_t>(ids_.size()));
  }
  void reserve(std::size_t spheres, std::size_t partners) {
    end_.reserve(spheres);
    ids_.reserve(partners);
  }
  [[nodiscard]] std::size_t partner_count() const { return ids_.size(); }
  [[nodiscard]] std::size_t memory() const { return ids_.capacity() * sizeof(CellId) + end_.capacity() * sizeof(end_[0]); }

 private:
  [[nodiscard]] std::size_t begin(std::size_t sphere) const { return sphere == 0 ? 0 : end_[sphere - 1]; }
  std::vector<CellId> ids_;
  std::vector<std::uint32_t> end_;
};

}  // namespace morula::cbm
