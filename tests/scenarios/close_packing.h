#pragma once
#include <array>
#include <string>

#include "core/vec3.h"

namespace morula::scenarios::test {

/// Places of a cubic close packing as the items of a study's `at`: four for each cubic cell of side `lattice` [µm], from the cells `first` to before
/// `last` of a block of `whole` cells around the origin.
inline std::string close_packed_places(const std::array<int, 3>& first, const std::array<int, 3>& last, const std::array<int, 3>& whole,
                                       double lattice) {
  std::string at;
  for (int x = first[0]; x < last[0]; ++x)
    for (int y = first[1]; y < last[1]; ++y)
      for (int z = first[2]; z < last[2]; ++z)
        for (const Vec3d& base : {Vec3d{0, 0, 0}, Vec3d{0.5, 0.5, 0}, Vec3d{0.5, 0, 0.5}, Vec3d{0, 0.5, 0.5}}) {
          const Vec3d corner{x - 0.5 * whole[0], y - 0.5 * whole[1], z - 0.5 * whole[2]};
          const Vec3d place = (corner + base + Vec3d{0.25, 0.25, 0.25}) * lattice;
          at += (at.empty() ? "[" : ", [") + std::to_string(place.x) + " um, " + std::to_string(place.y) + " um, " +
                std::to_string(place.z) + " um]";
        }
  return at;
}

}  // namespace morula::scenarios::test
