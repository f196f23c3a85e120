#include "core/cell_id_text.h"

#include <charconv>

namespace morula {

std::optional<CellId> cell_id_of(std::string_view text) {
  std::uint64_t founder = 0;
  const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), founder);
  if (code != std::errc() || founder == 0 || founder >> CellId::kFounderBits != 0) return std::nullopt;
  CellId out = CellId::founder(founder);
  std::string_view path = text.substr(static_cast<std::size_t>(stop - text.data()));
  if (path.empty()) return out;
  if (path.front() != '.' || path.size() == 1) return std::nullopt;
  for (const char which : path.substr(1)) {
    if ((which != '0' && which != '1') || !out.can_divide()) return std::nullopt;
    out = out.daughter(which - '0');
  }
  return out;
}

bool descends_from(CellId cell, CellId ancestor) {
  const int later = cell.generation() - ancestor.generation();
  return later >= 0 && cell.founder_number() == ancestor.founder_number() &&
         cell.bits() >> (CellId::kFounderBits + later) == ancestor.bits() >> CellId::kFounderBits;
}

}  // namespace morula
