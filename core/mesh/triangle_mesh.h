#pragma once
#include <vector>

#include "core/mesh/topology.h"
#include "core/vec3.h"

namespace morula {

/// Nodes and faces of any triangle mesh, open or closed, checked or not.
struct TriangleMesh {
  std::vector<Vec3d> position;
  std::vector<Triangle> faces;
};

}  // namespace morula
