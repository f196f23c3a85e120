#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/convex_hull.h"

namespace morula::scenarios {

/// A ball in which no cell is.
struct Hollow {
  Vec3d center{};
  double radius = 0.0;  ///< [µm]
};

/// Volumes of the regions that are nearer to one place than to any other [µm³], by place: Voronoi regions (1908) within the convex hull of all places inflated by
/// `margin` [µm], less a hollow. Places that `groups` say are the same share their region evenly.
///
/// Each region is seen from its place: V = 1/3 ∮ r³ dω over 2,000 directions evenly spread (core/spiral.h), r to the nearest of the planes
/// halfway to other places, the inflated hull and the hollow. For flat-sided regions that is right to 0.3 %; the sum is that of the hull less the hollow to rounding, for all are
/// scaled by one factor. A place within the hollow has its region as if there were none.
std::vector<double> nearest_regions(const ConvexHull& hull, std::span<const Vec3d> places, std::span<const std::vector<std::size_t>> groups,
                                    double margin, const std::optional<Hollow>& hollow);

}  // namespace morula::scenarios
