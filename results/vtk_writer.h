#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "results/snapshot.h"

namespace morula::scenarios {

/// Files that ParaView reads (VTK XML, data inline in base64 as little-endian with 64-bit lengths). Written aside and renamed, never half.
///
/// `shells_NNNNNN.vtu`: the faces of all shells as triangles, every number of a cell on each of its faces. `spheres_NNNNNN.vtu`: centres of
/// all spheres as points with the same numbers (`radius [um]` scales a sphere glyph). `obstacles_NNNNNN.vtu`: obstacles and walls.
/// `field_<name>_NNNNNN.vti`: a field as voxels. All files of a kind hold the same arrays, also when they hold no cell; names carry units.
/// Cell ids are unsigned 64-bit (CellId::bits). What the numbers of kinds mean stands in the field data: the array `type liver` holds the
/// number of the type liver, and so for `body` and `phase`.
Status write_vtk(const Snapshot& snapshot, const std::filesystem::path& folder, std::size_t number);

/// `shells.pvd`, `spheres.pvd` and `field_<name>.pvd`: the files above with their times in seconds. `times[i]` belongs to number `numbers[i]`.
Status write_vtk_collections(const std::filesystem::path& folder, const std::vector<std::size_t>& numbers, const std::vector<double>& times,
                             const std::vector<std::string>& field_names);

/// Base64 (RFC 4648, with padding).
std::string base64(std::span<const std::byte> bytes);

}  // namespace morula::scenarios
