#pragma once
#include <span>
#include <vector>

#include "core/mesh/renewal/surface_view.h"

namespace morula {

/// Move the nodes of a closed mesh along their normals so that it has this area [µm²] and encloses this volume [µm³]: the way of least Σ a |u|² over
/// the nodes with area a that meets both, a combination of mean curvature and of an even layer. Returns the longest way of a node [µm]; a negative
/// number, and x as it was, where there is none within `most` [µm]: on a sphere, which has the least area for its volume.
double give_area_back(std::span<const Triangle> faces, double area, double volume, double most, std::vector<Vec3d>& x);

}  // namespace morula
