#pragma once
#include "core/space/space.h"

namespace morula {

/// Calls function(shift) for the shifts from a box to itself and to the boxes around it along the periodic axes: 1 to 27 of them [µm].
template <class F>
void for_boxes_around(const Space& space, F&& function) {
  const Vec3d edges = space.box.size();
  const auto most = [&](int axis) { return space.periodic(axis) ? 1 : 0; };
  for (int x = -most(0); x <= most(0); ++x)
    for (int y = -most(1); y <= most(1); ++y)
      for (int z = -most(2); z <= most(2); ++z) function(Vec3d{x * edges.x, y * edges.y, z * edges.z});
}

}  // namespace morula
