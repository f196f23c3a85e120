#pragma once
#include <algorithm>
#include <array>
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

/// Places of a cubic close packing: four for each cubic cell of side `lattice`, from the cells `first` to before `last` of a block of `whole` cells around the origin.
inline std::vector<Vec3d> close_packed_block(const std::array<int, 3>& first, const std::array<int, 3>& last,
                                             const std::array<int, 3>& whole, double lattice) {
  std::vector<Vec3d> out;
  for (int x = first[0]; x < last[0]; ++x)
    for (int y = first[1]; y < last[1]; ++y)
      for (int z = first[2]; z < last[2]; ++z)
        for (const Vec3d& base : {Vec3d{0, 0, 0}, Vec3d{0.5, 0.5, 0}, Vec3d{0.5, 0, 0.5}, Vec3d{0, 0.5, 0.5}}) {
          const Vec3d corner{x - 0.5 * whole[0], y - 0.5 * whole[1], z - 0.5 * whole[2]};
          out.push_back((corner + base + Vec3d{0.25, 0.25, 0.25}) * lattice);
        }
  return out;
}

}  // namespace morula
