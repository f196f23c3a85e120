#pragma once
#include "core/mesh/mesh_check.h"

namespace morula::scenarios {

/// The code of a message about this problem of a mesh.
int code_of(MeshProblemKind kind);

}  // namespace morula::scenarios
