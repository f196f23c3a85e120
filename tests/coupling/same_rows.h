#pragma once
#include <cstring>

#include "coupling/cells.h"

namespace morula {

/// Two rows with the same bits.
inline bool same_rows(const CellState& a, const CellState& b) {
  const auto same = [](const auto& one, const auto& other) { return std::memcmp(&one, &other, sizeof one) == 0; };
  return same(static_cast<const CellRow&>(a), static_cast<const CellRow&>(b)) &&
         same(static_cast<const OptionalValues&>(a), static_cast<const OptionalValues&>(b)) && a.variables.size() == b.variables.size() &&
         (a.variables.empty() || std::memcmp(a.variables.data(), b.variables.data(), a.variables.size() * sizeof(double)) == 0);
}

}  // namespace morula
