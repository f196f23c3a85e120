#include "cbm/partners.h"

#include <algorithm>

namespace morula::cbm {

bool adheres(std::span<const CellId> partners, CellId other) { return std::binary_search(partners.begin(), partners.end(), other); }

void set_adheres(Partners& partners, CellId other, bool attached) {
  const auto place = std::lower_bound(partners.begin(), partners.end(), other);
  const bool present = place != partners.end() && *place == other;
  if (attached && !present) partners.insert(place, other);
  if (!attached && present) partners.erase(place);
}

Partners daughter_partners(const Partners& mother_partners, CellId sister) {
  Partners partners = mother_partners;
  set_adheres(partners, sister, true);
  return partners;
}

void replace_partner(Partners& partners, CellId mother, CellId first, CellId second) {
  if (!adheres(partners, mother)) return;
  set_adheres(partners, mother, false);
  set_adheres(partners, first, true);
  set_adheres(partners, second, true);
}

void PartnerLists::set(std::size_t sphere, std::span<const CellId> partners) {
  List& list = lists_[sphere];
  const std::uint32_t had = room(list.count), needs = room(partners.size());
  if (needs > had) {
    left_ += had;
    list = store(partners);
  } else {
    left_ += had - needs;
    std::ranges::copy(partners, store_.begin() + list.first);
    list.count = static_cast<std::uint32_t>(partners.size());
  }
  if (left_ > 64 + store_.size() / 16) take_back_what_was_left();
}

PartnerLists::List PartnerLists::store(std::span<const CellId> partners) {
  const List list{static_cast<std::uint32_t>(store_.size()), static_cast<std::uint32_t>(partners.size())};
  const std::size_t size = store_.size() + room(partners.size());
  if (size > store_.capacity()) store_.reserve(size + size / 16);  // no growth by doubling
  store_.insert(store_.end(), partners.begin(), partners.end());
  store_.resize(size);
  return list;
}

void PartnerLists::reserve(std::size_t spheres, std::size_t partners) {
  lists_.reserve(spheres);
  store_.reserve(partners + spheres / 2);  // half of the lists have room for one more
}

void PartnerLists::take_back_what_was_left() {
  std::vector<CellId> old;
  old.swap(store_);
  store_.reserve(old.size() - left_ + old.size() / 16);
  for (List& list : lists_) list = store(std::span(old).subspan(list.first, list.count));
  left_ = 0;
}

}  // namespace morula::cbm
