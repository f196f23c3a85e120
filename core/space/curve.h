#pragma once
#include <cstdint>

#include "core/vec3.h"

namespace morula {

/// Place of a point along the Morton curve over cubes of side 2 µm; any finite point within ±2 m. Near points have near places, and the
/// place depends on nothing but the point: cells sorted by it have the same order on any number of ranks.
inline std::uint64_t curve_place(const Vec3d& point) {
  const auto spread = [](double coordinate) {
    auto v = static_cast<std::uint64_t>(static_cast<std::int64_t>(coordinate * 0.5 + 1048576.0)) & 0x1FFFFF;  // 21 bits
    v = (v | v << 32) & 0x1F00000000FFFF;
    v = (v | v << 16) & 0x1F0000FF0000FF;
    v = (v | v << 8) & 0x100F00F00F00F00F;
    v = (v | v << 4) & 0x10C30C30C30C30C3;
    v = (v | v << 2) & 0x1249249249249249;
    return v;
  };
  return spread(point.x) | spread(point.y) << 1 | spread(point.z) << 2;
}

}  // namespace morula
