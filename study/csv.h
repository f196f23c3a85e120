#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/numbers/unit_conversion.h"
#include "coupling/model.h"
#include "study/diagnostics.h"

namespace morula::scenarios {

/// One row of a CSV file of cells.
struct CsvCell {
  Vec3d position{};  ///< [µm]
  std::uint16_t type = 0;
  double radius = 0.0;           ///< of the cell at time 0 [µm]; 0: not given, drawn from its type
  double phase = -1.0;           ///< point of its cycle, 0 (birth) to 1 (division); −1: not given
  std::optional<BodyKind> body;  ///< not given: as the study says
  int line = 0;                  ///< in the file, from 1
};

/// The cells of a CSV file in the order of the file.
struct CsvCells {
  std::vector<CsvCell> cells;
  std::vector<std::string> ignored_columns;
  bool common_unit_used = false;             ///< some column has the unit of all
  std::shared_ptr<const SourceText> source;  ///< for messages about rows
};

/// Read cells from a CSV file: the header names the columns `x`, `y`, `z`, `type` and optionally `radius`, `phase`, `model` in any order, each
/// lengths with their unit as `x [um]`, or all in `unit` where that is not empty (E655 where neither is said); other columns are listed and left aside. Lines that are empty or begin with `#` are
/// skipped. All errors are added with file, line and column: E601–E605 (file), E610 (header), E611 (short or long row), E612 (a value is not a
/// number, is NA or not finite), E613 (no rows), E401 (unknown type). `referred_from` is where the study names the file.
std::optional<CsvCells> read_cells_csv(const std::filesystem::path& path, const std::string& shown_name,
                                       const std::vector<std::string>& type_names, const Place& referred_from, const UnitSystem& units,
                                       Diagnostics& diagnostics, const std::string& unit = "");

/// Groups of cells (indices, increasing) that lie closer than `below` [µm] to another of their group; groups in the order of their first cell.
std::vector<std::vector<std::size_t>> coincident_groups(const std::vector<Vec3d>& positions, double below);

/// Move all but the first cell of each group by `shift` [µm] along a random direction that depends only on the seed and the cell's number;
/// cell k has the number `first_number` + k.
void move_apart(std::vector<Vec3d>& positions, const std::vector<std::vector<std::size_t>>& groups, double shift,
                std::uint64_t first_number, std::uint32_t seed);

}  // namespace morula::scenarios
