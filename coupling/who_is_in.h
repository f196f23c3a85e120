#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel/comm.h"
#include "coupling/cell_view.h"
#include "coupling/mechanics/mechanics.h"
#include "coupling/tissue.h"

namespace morula {

/// Where the centres of the regions of bodies are now: some follow the tissue, some an obstacle. Collective.
std::vector<Vec3d> centers_of_regions(const Model& model, const Tissue& tissue, std::span<const Vec3d> center, const Comm& comm);

/// How the cell of row i stands to a region of the model: `from` is its place less that of the region's centre, `contacts` are those of
/// contacts_from_regions(); where there are none, nobody is in a region that counts them.
Standing standing(const Model& model, std::size_t number, const CellView& cell, std::size_t i, const Vec3d& from,
                  std::span<const std::vector<std::uint32_t>> contacts);

/// By region and row: how many contacts the cells of this rank are away from those that the region counts from; empty for regions that do not count.
/// Collective.
std::vector<std::vector<std::uint32_t>> contacts_from_regions(const Model& model, const Tissue& tissue, std::span<const Vec3d> center,
                                                              Mechanics& mechanics, const Comm& comm);

}  // namespace morula
