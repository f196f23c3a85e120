#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
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

/// The partners of all spheres of a rank.
///
/// All lists lie in one store, each in room for an even number of partners: one that changes leaves the others where they are. What lists
/// leave behind is taken back when it has become a sixteenth of the store.
class PartnerLists {
 public:
  /// Where in the store a list lies.
  struct List {
    std::uint32_t first, count;
  };

  [[nodiscard]] std::size_t size() const { return lists_.size(); }
  [[nodiscard]] std::span<const CellId> operator[](std::size_t sphere) const {
    return std::span(store_).subspan(lists_[sphere].first, lists_[sphere].count);
  }
  /// The partners of the next sphere, sorted.
  void push_back(std::span<const CellId> partners) { lists_.push_back(store(partners)); }
  /// Other partners for a sphere, sorted; not a view of these lists.
  void set(std::size_t sphere, std::span<const CellId> partners);
  void reserve(std::size_t spheres, std::size_t partners);

  // --- For who puts lists of other spheres among these (coupling/cell_record.cpp): rows move, what they say stays where it is.
  [[nodiscard]] std::vector<List>& rows() { return lists_; }
  /// A list that no row has yet.
  [[nodiscard]] List store(std::span<const CellId> partners);
  /// The row of a sphere is about to go.
  void leave(std::size_t sphere) { left_ += room(lists_[sphere].count); }

  [[nodiscard]] std::size_t memory() const { return store_.capacity() * sizeof(CellId) + lists_.capacity() * sizeof(List); }

 private:
  [[nodiscard]] static std::uint32_t room(std::size_t count) { return static_cast<std::uint32_t>(count + count % 2); }
  void take_back_what_was_left();

  std::vector<CellId> store_;
  std::vector<List> lists_;  ///< by sphere
  std::size_t left_ = 0;     ///< entries of the store that no list has any more
};

}  // namespace morula::cbm
