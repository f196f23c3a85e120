#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace morula {

/// A number (or several) that a file gives for each of its parts or points.
struct MeshArray {
  std::string name;
  std::size_t components = 1;
  std::vector<double> values;  ///< component fastest

  [[nodiscard]] std::size_t count() const { return components == 0 ? 0 : values.size() / components; }
};

/// Triangles as a file groups them, before anybody has judged what they enclose. A part is what the format itself keeps together: a
/// polyhedron, a polygon or a cell of VTK, a `solid` of STL, an object (or else a group) of OBJ.
struct LabelledMesh {
  TriangleMesh mesh;                ///< [µm]; polygons are split into fans
  std::vector<std::uint32_t> part;  ///< by face, 0 … part_count − 1
  std::uint32_t part_count = 0;     ///< parts without faces (points, lines) count too, as arrays by part have them
  std::vector<char> is_closed;      ///< by part: a polyhedron, a solid, an object: meant as one surface; a polygon is not
  bool has_indices = true;          ///< faces name common nodes; STL repeats them in every face instead
  std::vector<MeshArray> part_arrays, point_arrays;
};

}  // namespace morula
