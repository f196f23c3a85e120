#pragma once
#include <optional>
#include <string>
#include <vector>

#include "coupling/cell_record.h"
#include "study/initial/cells_from_meshes.h"
#include "study/initial/surroundings.h"
#include "study/study.h"

namespace morula::scenarios {

/// A cell whose row and place are settled, its body still to be made.
struct PlacedCell {
  CellState row;
  Vec3d center{};
  CellShape shape = CellShape::kSphere;
  Orientation orientation = Orientation::kRandom;
  std::optional<MeshCell> surface{};  ///< its own, instead of a shape
  const MeshCells* meshes = nullptr;
  std::size_t entry = 0;  ///< of `initial`

  /// Of a ball with its volume at time 0 [µm].
  [[nodiscard]] double radius() const;
};

/// What keeps an entry's cells from their places: a code of `error_codes()`, what, and what would be right.
struct PlaceProblem {
  int code = 0;
  std::size_t entry = 0;
  std::string text, help;
  bool is_warning = false;
};

struct PlacedCells {
  std::vector<PlacedCell> cells;       ///< by founder's number, from 1
  std::vector<std::string> notes;      ///< for the log: blocks that do not fit their shape, overlaps that remain
  std::vector<PlaceProblem> problems;  ///< E505, E658: the cells of the entry are left out
};

/// Shells may touch but not overlap at the start; spheres may lie this much of the sum of their radii apart.
inline constexpr double kTouchOfShells = 1.0;
inline constexpr double kTouchOfSpheres = 0.95;

/// The cells of all entries of `initial`, in the order of the study, each beside what is there already: obstacles, and for a fill the cells of
/// earlier entries. A pure function of the study, whatever the number of threads.
/// Errors: kFile/kInput for a CSV or mesh file that has changed since the check, kInput for obstacles that are no closed surfaces.
Result<PlacedCells> place_cells(const Study& study, int threads = 1);

/// The cell with its body. Errors (kInput) name the cell.
Result<CellRecord> with_body(const PlacedCell& cell, const Model& model, ShapeLibrary& shapes);

}  // namespace morula::scenarios
