#pragma once
#include <array>

#include "core/vec3.h"

namespace morula {

/// An axis-aligned box; empty when low > high.
struct Box {
  Vec3d low{1e300, 1e300, 1e300};
  Vec3d high{-1e300, -1e300, -1e300};

  void include(const Vec3d& p) {
    low = {low.x < p.x ? low.x : p.x, low.y < p.y ? low.y : p.y, low.z < p.z ? low.z : p.z};
    high = {high.x > p.x ? high.x : p.x, high.y > p.y ? high.y : p.y, high.z > p.z ? high.z : p.z};
  }
  void include(const Box& b) {
    include(b.low);
    include(b.high);
  }
  [[nodiscard]] Box inflated(double by) const { return {low - Vec3d{by, by, by}, high + Vec3d{by, by, by}}; }
  [[nodiscard]] bool overlaps(const Box& b) const {
    return low.x <= b.high.x && high.x >= b.low.x && low.y <= b.high.y && high.y >= b.low.y && low.z <= b.high.z && high.z >= b.low.z;
  }
  [[nodiscard]] bool contains(const Vec3d& p) const {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
  }
  [[nodiscard]] bool empty() const { return low.x > high.x; }
  [[nodiscard]] Vec3d size() const { return high - low; }
  [[nodiscard]] Vec3d center() const { return (low + high) * 0.5; }
};

enum class BoundaryKind {
  kOpen,      ///< cells may leave; fields end there
  kWall,      ///< a rigid, frictionless plane that cells cannot pass
  kPeriodic,  ///< what leaves on one side comes in on the other; always both faces of an axis
};

/// The domain: a box centred where the study says, and what happens at each face.
struct Space {
  Box box;
  /// Per axis, then low and high face.
  std::array<std::array<BoundaryKind, 2>, 3> boundary{};

  [[nodiscard]] bool periodic(int axis) const { return boundary[axis][0] == BoundaryKind::kPeriodic; }
  [[nodiscard]] bool any_periodic() const { return periodic(0) || periodic(1) || periodic(2); }
  /// The shortest vector from a to b over all periodic images.
  [[nodiscard]] Vec3d nearest_image(Vec3d from_a_to_b) const;
  /// The point's image inside the box, low <= p < high along periodic axes; a point that is there already stays bit for bit.
  [[nodiscard]] Vec3d wrapped(Vec3d p) const;
};

}  // namespace morula
