#pragma once
#include <optional>

#include "core/mesh/triangle_mesh.h"

namespace morula {

/// Whether this build has CGAL's mesh processing (CMake option MORULA_WITH_GPL). It is under GPL-3-or-later, and so is then the program as a whole.
bool has_isotropic_remeshing();

/// CGAL's isotropic remeshing of a closed, oriented surface to edges of about `edge`, nodes on the given surface; nothing where
/// CGAL refuses the mesh, or is not there.
std::optional<TriangleMesh> isotropic_remeshing(const TriangleMesh& mesh, double edge, int iterations);

}  // namespace morula
