#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace morula {

/// One of the surfaces a mesh was split into.
struct SplitSurface {
  double label = 0.0;
  TriangleMesh mesh;                ///< with the nodes its faces name, in increasing order of their old numbers
  std::vector<std::uint32_t> face;  ///< old number of each face
  std::vector<std::uint32_t> node;  ///< old number of each node
};

/// One surface for each label of the faces, in increasing order of the labels; nodes that two labels share are given to both.
std::vector<SplitSurface> split_by_label(const TriangleMesh& mesh, std::span<const double> label_of_face);

/// Number of the connected component of each face, through common nodes; components are numbered in the order of their first faces.
std::vector<double> components_of_faces(const TriangleMesh& mesh);

}  // namespace morula
