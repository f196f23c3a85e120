#pragma once
#include "core/mesh/triangle_mesh.h"

namespace morula {

/// The icosahedron subdivided `level` times (each face into four), nodes on the unit sphere: 10·4^level + 2 nodes, 20·4^level faces,
/// outward orientation. Twelve nodes have five neighbours, all others six. Nodes are in near-neighbour order (node_order.h).
/// Precondition: 0 <= level <= 10.
TriangleMesh make_icosphere(int level);

}  // namespace morula
