#include "core/space/space.h"

#include <cmath>

namespace morula {

Vec3d Space::nearest_image(Vec3d d) const {
  const Vec3d size = box.size();
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (periodic(static_cast<int>(axis))) d[axis] -= size[axis] * std::round(d[axis] / size[axis]);
  return d;
}

Vec3d Space::wrapped(Vec3d p) const {
  const Vec3d size = box.size();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool inside = p[axis] >= box.low[axis] && p[axis] < box.high[axis];
    if (inside || !periodic(static_cast<int>(axis))) continue;
    p[axis] -= size[axis] * std::floor((p[axis] - box.low[axis]) / size[axis]);
    if (p[axis] >= box.high[axis] || p[axis] < box.low[axis]) p[axis] = box.low[axis];  // rounding may reach the face or miss it by a bit
  }
  return p;
}

}  // namespace morula
