#pragma once
#include <filesystem>
#include <string_view>

#include "core/mesh/labelled_mesh.h"
#include "core/mesh/triangle_mesh.h"
#include "core/result.h"

namespace morula {

struct SurfaceFileOptions {
  double scale = 1.0;  ///< coordinates in the file × scale = µm
  /// Nodes nearer than this part of the diagonal of the whole surface become one; 0 unites only equal ones. STL repeats each node in every
  /// face, rounded to single precision (6·10⁻⁸).
  double weld = 1e-6;
};

/// Read a surface by the ending of its name, .stl or .obj (any case). Nothing but the file is judged here: see check_mesh() for the surface.
///
/// Nodes are united as `weld` says (each goes to the lowest-numbered one in reach) and nodes that no face names are dropped; a face
/// that collapses stays, as a face that names a node twice. Errors (kFile): file missing, unreadable, empty, of another format, truncated, a
/// number that is none or not finite, an index out of range, each with file and line or byte.
Result<TriangleMesh> read_surface(const std::filesystem::path& file, const SurfaceFileOptions& options = {});

/// STL, text or binary (told by the size that a binary file announces, not by the word "solid", with which binary files may begin too).
Result<TriangleMesh> read_stl(const std::filesystem::path& file, const SurfaceFileOptions& options = {});

/// Wavefront OBJ: `v` and `f` (i, i/t, i//n, i/t/n, negative from the end, polygons split into a fan); texture, normals, groups and
/// materials are passed over.
Result<TriangleMesh> read_obj(const std::filesystem::path& file, const SurfaceFileOptions& options = {});

/// Read the faces of a .vtk (legacy), .stl or .obj file with what the file itself keeps together; nodes are as the file has them, not united.
/// Coordinates in the file × scale = µm. Errors as those of read_surface() and read_vtk().
Result<LabelledMesh> read_labelled_mesh(const std::filesystem::path& file, double scale);

/// Write binary STL (single precision), aside first and then renamed: a full disk leaves no half file and keeps an older one.
Status write_stl(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace morula
