#pragma once
#include <algorithm>
#include <span>

#include "core/vec3.h"
#include "results/snapshot.h"

namespace morula::scenarios {

/// Where the picture is taken from: orthographic, so that one scale bar is right everywhere in it.
struct Camera {
  Vec3d center;                  ///< seen in the middle of the view [µm]
  Vec3d right{1.0, 0.0, 0.0};    ///< unit, to the right of the picture
  Vec3d up{0.0, 0.0, 1.0};       ///< unit, to its top
  Vec3d toward{0.0, -1.0, 0.0};  ///< unit, from the tissue to the eye; right × up
  double pixels_per_um = 1.0;

  /// Coordinates of a point in the picture's frame: right, up, towards the eye [µm].
  [[nodiscard]] Vec3d view(const Vec3d& p) const {
    const Vec3d d = p - center;
    return {dot(d, right), dot(d, up), dot(d, toward)};
  }
};

/// The half of the space that is shown: the one `normal` points away from.
struct CutPlane {
  Vec3d point;   ///< [µm]
  Vec3d normal;  ///< unit; points to what is removed
};

/// Camera that looks at the tissue from this azimuth and elevation [rad] (azimuth 0: along +y), not yet fitted.
Camera make_camera(double azimuth, double elevation);

/// Centre the camera on all of these snapshots and scale it so that the largest fits `width` × `height` pixels with a rim.
/// Nothing in sight: centre at the origin, 100 µm across.
void fit_camera(Camera& camera, std::span<const Snapshot> snapshots, double width, double height);

/// Mean of the cells' centroids, or the origin.
Vec3d middle_of(const Snapshot& snapshot);

/// The largest of 1, 2, 5 × 10^k that is at most `limit` (> 0).
double nice_below(double limit);

}  // namespace morula::scenarios
