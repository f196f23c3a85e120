#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/surface_pair.h"

namespace morula {

/// Faces of a surface whose boxes overlap a box, in increasing order; into `faces`.
///
/// A face's box is beyond one of the six planes exactly when all its nodes are: one look at each node instead of three at each face.
inline void faces_in_box(const PairBody& body, const Box& box, std::vector<std::uint32_t>& faces) {
  std::vector<std::uint8_t> beyond(body.position.size());  // one bit for each plane
  for (std::uint32_t i = 0; i < beyond.size(); ++i) {
    const Vec3d x = body.node(i);
    beyond[i] = static_cast<std::uint8_t>((x.x < box.low.x) | (x.x > box.high.x) << 1 | (x.y < box.low.y) << 2 | (x.y > box.high.y) << 3 |
                                          (x.z < box.low.z) << 4 | (x.z > box.high.z) << 5);
  }
  faces.clear();
  const auto triangles = body.topology->faces();
  for (std::uint32_t face = 0; face < triangles.size(); ++face) {
    const Triangle& t = triangles[face];
    if ((beyond[t[0]] & beyond[t[1]] & beyond[t[2]]) == 0) faces.push_back(face);
  }
}

}  // namespace morula
