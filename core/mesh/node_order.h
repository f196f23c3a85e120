#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace morula {

/// New numbers of the nodes (by old number) such that neighbours have near numbers: reverse Cuthill–McKee on the graph of edges
/// (Cuthill & McKee 1969, doi:10.1145/800195.805928). Every component starts at its node of lowest degree; all ties go to the lower old number, so
/// that the result depends on the faces alone. Precondition: all indices below node_count.
std::vector<std::uint32_t> near_neighbour_order(std::uint32_t node_count, std::span<const Triangle> faces);

/// The same surface with nodes renumbered by near_neighbour_order(), every face starting at its lowest node, faces in increasing order of
/// their nodes: a loop over the faces or edges then walks through the nodes.
TriangleMesh with_near_neighbour_order(const TriangleMesh& mesh);

}  // namespace morula
