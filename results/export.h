#pragma once
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>

#include "core/mesh/topology.h"
#include "core/result.h"
#include "results/snapshot.h"

namespace morula::scenarios {

enum class ExportFormat { kVtk, kCsv, kStl };

/// Which snapshots: every n-th of those from one time to another [s].
struct ExportRange {
  std::size_t every = 1;
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
};

/// Writes the snapshots of a results.h5 into a folder: vtk as write_vtk with collections; csv one table of cells a snapshot; stl one file of all surfaces a snapshot.
/// Returns the number of snapshots. kInput when the range holds none.
Result<std::size_t> export_snapshots(const std::filesystem::path& results, const std::filesystem::path& folder, ExportFormat format,
                                     const ExportRange& range);

/// Table of cells with units in the header: ids as text (`17.01`), type and phase by name.
[[nodiscard]] std::string cells_as_csv(const Snapshot& snapshot);

/// Binary STL [µm] of the surfaces of all cells, or of one (its index). Spheres are drawn with the 162 nodes of an icosphere on their surface.
[[nodiscard]] Result<std::string> surfaces_as_stl(const Snapshot& snapshot, ShapeLibrary& library, std::ptrdiff_t only_cell = -1);

}  // namespace morula::scenarios
