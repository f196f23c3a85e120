#pragma once
#include <limits>

#include "report/pictures/camera.h"

namespace morula::scenarios {

/// Points of space to pixels (x right, y down; pixel (i, j) has its centre at i + ½, j + ½) and depth towards the eye [µm].
struct Projection {
  Camera camera;
  double middle_x = 0.0, middle_y = 0.0;  ///< where camera.center is seen [px]

  [[nodiscard]] Vec3d pixel(const Vec3d& p) const {
    const Vec3d v = camera.view(p);
    return {middle_x + v.x * camera.pixels_per_um, middle_y - v.y * camera.pixels_per_um, v.z};
  }
  /// A direction in the view frame (right, up, towards the eye).
  [[nodiscard]] Vec3d direction(const Vec3d& d) const { return {dot(d, camera.right), dot(d, camera.up), dot(d, camera.toward)}; }
};

/// A sphere as it is drawn.
struct Disc {
  double x, y;    ///< centre [px]
  double depth;   ///< centre, towards the eye [µm]
  double radius;  ///< [µm]
  std::int32_t surface;
};

/// Depth of the cut plane under each pixel; infinite without a cut.
class ClipDepth {
 public:
  ClipDepth() = default;
  ClipDepth(const Projection& projection, const CutPlane& cut) {
    const Vec3d n = projection.direction(cut.normal), p = projection.pixel(cut.point);
    // n.x (x − p.x)/s − n.y (y − p.y)/s + n.z (z − p.z) = 0, s pixels per µm, y down
    per_x_ = -n.x / (n.z * projection.camera.pixels_per_um);
    per_y_ = n.y / (n.z * projection.camera.pixels_per_um);
    offset_ = p.z - per_x_ * (p.x - 0.5) - per_y_ * (p.y - 0.5);
  }
  /// [µm]
  [[nodiscard]] double at(int x, int y) const { return offset_ + per_x_ * x + per_y_ * y; }

 private:
  double per_x_ = 0.0, per_y_ = 0.0, offset_ = std::numeric_limits<double>::infinity();
};

}  // namespace morula::scenarios
