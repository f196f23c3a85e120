#pragma once
#include <vector>

#include "core/mesh/renewal/surface_view.h"

namespace morula {

/// How long edges are to be at the nodes of a surface, by node [µm]: those of a mesh of `nodes` equal triangles, and 0.3/|H| where that is less (dcm.md §14:
/// H = (1/R1 + 1/R2)/2 the mean curvature), but at least `finest` of them. Where such a mesh would have more than `most_nodes`, all are longer by the same factor.
///
/// |H| at a node is ¼ Σ l θ / A over its edges of length l, at which the surface is bent by θ, with a third of the area of its faces, A; both sums are taken over
/// the node and its neighbours.
std::vector<double> wanted_edges(const SurfaceView& surface, double nodes, double most_nodes, double finest);

}  // namespace morula
