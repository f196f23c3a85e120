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

}  // namespace morula::cbm
