#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/result.h"
#include "coupling/cell_record.h"
#include "study/mesh_cells.h"

namespace morula::scenarios {

/// A cell as its surface in the file says it.
struct MeshCell {
  std::string name;     ///< for messages: "embryo.vtk, cell 9"
  TriangleMesh mesh;    ///< closed, outwards [µm]
  double volume = 0.0;  ///< [µm³]
  std::uint16_t type = 0;
  std::optional<double> pressure;  ///< [kPa]
};

/// Something about the files that keeps them from being used: a code of `error_codes()`, what, where, and what would be right.
struct MeshCellProblem {
  int code = 0;
  std::string text, help;
};

struct MeshCellsRead {
  std::vector<MeshCell> cells;     ///< in the order of the files, in a file by part, by first face, or by id
  std::vector<std::string> notes;  ///< for the log: each repair, crossings that remeshing will smooth, the deepest overlap
  std::vector<MeshCellProblem> problems;
};

/// Read the cells, mend their surfaces, and judge them: E545–E550 and E620–E625 (docs/study_reference.md). With `judge` false the costly
/// judgements are left out (crossings, overlaps): the files have passed them before. `type` is that of all cells where nothing else is said.
MeshCellsRead read_mesh_cells(const MeshCells& spec, std::uint16_t type, bool judge);

/// The surface the cell starts with: that of the file, or remeshed as the study says. Errors (kInput) name the cell.
struct CellSurface {
  TriangleMesh mesh;
  double mean_edge = 0.0;     ///< [µm]
  double volume_error = 0.0;  ///< by remeshing, before the volume was given back
};
Result<CellSurface> cell_surface(const MeshCell& cell, const MeshCells& spec);

/// That surface as a shell at rest: its membrane is free of stress, its nodes are where the file has them.
Result<ShellRecord> shell_of_surface(const MeshCell& cell, const MeshCells& spec, double reference_volume, ShapeLibrary& shapes);

/// A place for messages: "(1, 2, 3) um".
std::string text_of_place(const Vec3d& p);

/// The target volume at which a free cell of tension γ and bulk modulus K_V would have the reference volume V0 = V exp(p/K_V), so that the
/// surface of volume V has the pressure p: t exp(2γ/(R(t) K_V)) = V exp(p/K_V), R(t) the radius of a sphere of volume t. [µm³]
double target_volume_of(double volume, double pressure, double tension, double bulk_modulus);

}  // namespace morula::scenarios
