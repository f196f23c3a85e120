#pragma once
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/result.h"
#include "core/vec3.h"

namespace morula {

/// The convex hull of points as a closed surface: corners are given points, faces are oriented outwards.
struct ConvexHull {
  std::vector<Vec3d> points;    ///< all points it was made of
  std::vector<Triangle> faces;  ///< indices into points
  double volume = 0.0;          ///< [µm³]
  double area = 0.0;            ///< [µm²]
  double mean_curvature = 0.0;  ///< M = ½ Σ l θ over the edges, θ the angle between the outward normals of their faces [µm]

  /// Volume of all points not farther than `margin` from the hull: V + A r + M r² + 4/3 π r³ (Steiner 1840). [µm³]
  [[nodiscard]] double inflated_volume(double margin) const;
  /// How deep a point lies below the hull's surface; negative outside, where it is the distance to the farthest face plane. [µm]
  [[nodiscard]] double depth(const Vec3d& point) const;
};

/// Convex hull by adding points one after the other, the farthest first: for each, the faces that see it are replaced by a cone over their
/// horizon (Preparata & Hong 1977, doi:10.1145/359423.359430; here without search structures: work grows as points × faces, meant for up to
/// some ten thousand points). A point less than 10⁻⁹ of the extent above a face counts as inside.
/// Errors: kInput when the points are fewer than four or lie in one plane.
Result<ConvexHull> convex_hull(std::vector<Vec3d> points);

}  // namespace morula
