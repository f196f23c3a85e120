#pragma once
#include "core/mesh/triangle_mesh.h"
#include "core/result.h"

namespace morula {

/// A tube around z with its mouth at z = 0 and its far, flat end at z = length: inner radius, thickness of the wall, and edges of the mouth
/// rounded with the radius `lip` (at most half the wall). Closed, outward faces, nodes on the ideal surface. Edges are `edge` long near the
/// mouth and up to four times as long farther than `inner_radius` from it. Lengths in µm. Errors: a length that is not positive and finite,
/// a lip too large for the wall, a tube shorter than twice its lip, or more than 10⁶ faces.
Result<TriangleMesh> make_pipette(double inner_radius, double wall, double lip, double length, double edge);

}  // namespace morula
