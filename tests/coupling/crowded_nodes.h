#pragma once
#include <cmath>
#include <span>

#include "coupling/cell_record.h"

namespace morula::test {

/// The nodes slide along a sphere from its poles towards its equator.
inline void crowd(std::span<Vec3d> nodes, double how_much) {
  const Vec3d center = mean_of(std::span<const Vec3d>(nodes));
  for (Vec3d& x : nodes) {
    const Vec3d d = x - center;
    const double r = norm(d), angle = std::acos(d.z / r), to = angle + how_much * std::sin(2.0 * angle), flat = std::hypot(d.x, d.y);
    if (flat > 1e-9 * r) x = center + Vec3d{d.x / flat * std::sin(to), d.y / flat * std::sin(to), std::cos(to)} * r;
  }
}

}  // namespace morula::test
