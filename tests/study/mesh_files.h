#pragma once
#include <string>
#include <vector>

#include "core/mesh/icosphere.h"
#include "core/mesh/triangle_mesh.h"
#include "core/numbers/number_text.h"

namespace morula::scenarios::test {

inline TriangleMesh ball(double radius, const Vec3d& center = {}, int level = 2) {
  TriangleMesh mesh = make_icosphere(level);
  for (Vec3d& p : mesh.position) p = center + p * radius;
  return mesh;
}

/// Cells as polyhedra of a legacy VTK file; `cell_data` stands after CELL_DATA, one value a cell.
inline std::string as_vtk(const std::vector<TriangleMesh>& cells, const std::string& cell_data = "") {
  std::string points, polyhedra, types;
  std::size_t count = 0, size = 0;
  for (const TriangleMesh& cell : cells) {
    for (const Vec3d& p : cell.position)
      points += number_text("%.9g", p.x) + " " + number_text("%.9g", p.y) + " " + number_text("%.9g", p.z) + "\n";
    polyhedra += std::to_string(1 + 4 * cell.faces.size()) + " " + std::to_string(cell.faces.size());
    for (const Triangle& f : cell.faces)
      polyhedra += " 3 " + std::to_string(f[0] + count) + " " + std::to_string(f[1] + count) + " " + std::to_string(f[2] + count);
    polyhedra += "\n";
    types += "42\n";
    count += cell.position.size();
    size += 2 + 4 * cell.faces.size();
  }
  const std::string n = std::to_string(cells.size());
  return "# vtk DataFile Version 4.2\ncells\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " + std::to_string(count) + " double\n" + points +
         "CELLS " + n + " " + std::to_string(size) + "\n" + polyhedra + "CELL_TYPES " + n + "\n" + types +
         (cell_data.empty() ? "" : "CELL_DATA " + n + "\n" + cell_data);
}

/// A study of cells from `meshes`, the keys of that section.
inline std::string mesh_study(const std::string& meshes, const std::string& entry = "type: cell, ") {
  return "schema: 1\nstudy: meshes\nseed: 3\ntime: {end: 4 s, output: 2 s, checkpoint: 2 s}\n"
         "domain: {size: [100 um, 100 um, 100 um], boundary: open}\n"
         "cell_types:\n"
         "  cell: {radius: 6 um, adhesion: {cell: 0.1 mJ/m^2}, dcm: {cortex: {tension: 0.2 mN/m}}}\n"
         "  other: {radius: 6 um, dcm: {cortex: {tension: 0.2 mN/m}}}\n"
         "contact: {range: 0.8 um}\n"
         "initial:\n  - {" +
         entry + "meshes: {" + meshes + "}}\noutput: {report: false}\n";
}

}  // namespace morula::scenarios::test
