#pragma once
#include <cmath>
#include <numbers>

#include "core/random/philox.h"
#include "core/vec3.h"

namespace morula {

/// A rotation as its three rows.
struct Rotation {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  friend Vec3d operator*(const Rotation& r, const Vec3d& v) { return {dot(r.x, v), dot(r.y, v), dot(r.z, v)}; }
};

/// A rotation, uniform over all rotations, from three uniform numbers (Shoemake 1992, Graphics Gems III, p. 124): draws `index` and
/// `index` + 1 of the cell.
inline Rotation random_rotation(const Random& random, CellId cell, std::uint64_t index) {
  const RandomPair u = random.uniform(cell, index);
  const double turn = 2.0 * std::numbers::pi * random.uniform(cell, index + 1).first;
  const double a = std::sqrt(1.0 - u.first), b = std::sqrt(u.first), angle = 2.0 * std::numbers::pi * u.second;
  const double x = a * std::sin(angle), y = a * std::cos(angle), z = b * std::sin(turn), w = b * std::cos(turn);  // unit quaternion
  return {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
          {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
          {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
}

}  // namespace morula
