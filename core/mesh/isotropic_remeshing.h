#pragma once
#include <optional>

#include "core/mesh/triangle_mesh.h"

namespace morula {

/// CGAL's isotropic remeshing of a closed, oriented surface to edges of about `edge`, nodes on the given surface; nothing where CGAL refuses the mesh.
std::optional<TriangleMesh> isotropic_remeshing(const TriangleMesh& mesh, double edge, int iterations);

}  // namespace morula
