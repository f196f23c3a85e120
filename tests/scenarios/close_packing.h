#pragma once
#include <array>
#include <string>

#include "core/close_packing.h"

namespace morula::scenarios::test {

/// close_packed_block() as the items of a study's `at`.
inline std::string close_packed_places(const std::array<int, 3>& first, const std::array<int, 3>& last, const std::array<int, 3>& whole,
                                       double lattice) {
  std::string at;
  for (const Vec3d& place : close_packed_block(first, last, whole, lattice))
    at += (at.empty() ? "[" : ", [") + std::to_string(place.x) + " um, " + std::to_string(place.y) + " um, " + std::to_string(place.z) +
          " um]";
  return at;
}

}  // namespace morula::scenarios::test
