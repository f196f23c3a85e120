#pragma once
#include "core/mesh/triangle_mesh.h"

namespace morula {

/// Unite nodes not farther apart than `distance` (0: equal ones) and drop those that no face names. In increasing order, each node joins the
/// lowest-numbered kept node in reach, or is kept itself: the result depends on the mesh alone. Precondition: coordinates finite, indices valid.
TriangleMesh with_welded_nodes(const TriangleMesh& mesh, double distance);

}  // namespace morula
