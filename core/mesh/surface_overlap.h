#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace morula {

/// How deep a closed surface reaches into another one.
struct SurfaceOverlap {
  std::size_t a = 0, b = 0;  ///< node of `a` inside `b`
  std::uint32_t node = 0;    ///< of a, the deepest
  std::uint32_t face = 0;    ///< of b, the nearest
  double depth = 0.0;        ///< distance of that node from the surface of b [µm]
  Vec3d place;               ///< of that node
};

/// For every ordered pair of surfaces whose nodes of the first lie inside the second: the deepest node, in increasing order of (a, b). A node is
/// inside where the pseudonormal at the nearest point says so and the surface winds around it. Surfaces must be closed and oriented outwards.
std::vector<SurfaceOverlap> find_overlaps(std::span<const TriangleMesh> surfaces);

}  // namespace morula
