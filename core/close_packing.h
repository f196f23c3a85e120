#pragma once
#include <algorithm>
#include <numbers>
#include <vector>

#include "core/vec3.h"

namespace morula {

/// Places of a cubic close packing with one at the origin, within n steps of its half cubes along each axis, nearest first and then by x, y, z. `spacing`: between neighbours.
inline std::vector<Vec3d> close_packed_places(int n, double spacing) {
  constexpr double kAlike = 1e-6;  // of squares of distances, in units of half cubes squared
  const double step = spacing / std::numbers::sqrt2;
  std::vector<Vec3d> out;
  for (int x = -n; x <= n; ++x)
    for (int y = -n; y <= n; ++y)
      for (int z = -n; z <= n; ++z)
        if ((x + y + z) % 2 == 0) out.push_back(Vec3d{step * x, step * y, step * z});
  std::ranges::stable_sort(out, [&](const Vec3d& a, const Vec3d& b) { return norm2(a) < norm2(b) - kAlike * step * step; });
  return out;
}

}  // namespace morula
