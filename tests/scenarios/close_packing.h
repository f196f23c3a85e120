#pragma once
#include <array>
#include <string>

#include "core/close_packing.h"
#include "scenarios/verify/run_study.h"

namespace morula::scenarios::test {

/// close_packed_block() as the items of a study's `at`.
inline std::string close_packed_places(const std::array<int, 3>& first, const std::array<int, 3>& last, const std::array<int, 3>& whole,
                                       double lattice) {
  return list_of_places(close_packed_block(first, last, whole, lattice));
}

}  // namespace morula::scenarios::test
