#pragma once
#include <filesystem>
#include <string_view>

#include "core/mesh/labelled_mesh.h"
#include "core/result.h"

namespace morula {

/// Read the surfaces of a legacy VTK file, versions 1 to 5, text or binary: POLYDATA with polygons and triangle strips, UNSTRUCTURED_GRID with
/// polyhedra, polygons, triangles, quadrilaterals and strips; with all numeric arrays of its cells and points. Points, lines, lookup tables and METADATA
/// are passed over. Coordinates in the file × scale = µm. (Format: VTK User's Guide, "Simple legacy formats".)
///
/// Every part is a cell of the file. Errors (kFile): file missing, unreadable, empty, no legacy VTK, another kind of data set, truncated, a number
/// that is none, a coordinate that is not finite, an index out of range, volumes such as tetrahedra; each with file and line or byte.
Result<LabelledMesh> read_vtk(const std::filesystem::path& file, double scale);

/// The same from the bytes of a file; `file` names it in messages.
Result<LabelledMesh> parse_vtk(const std::filesystem::path& file, std::string_view content, double scale);

}  // namespace morula
