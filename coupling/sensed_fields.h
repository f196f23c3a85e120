#pragma once
#include <span>
#include <vector>

#include "core/parallel/comm.h"
#include "coupling/tissue.h"

namespace morula {

bool any_senses_a_field(std::span<const CellType> types);

/// What the cells of these rows sense of one field, in their order.
///
/// Six points of each cell, a radius of its target volume away from its centre (`center`, in the order of `rows`) along the axes, take the trilinear interpolation of the
/// voxels around them: the gradient of a linear field is exact, but for points within half a voxel of a face without a flux, towards which a field goes on as it
/// is in the voxel. Within half a voxel of a face with a concentration it goes straight to that. Collective.
Result<std::vector<SensedField>> sense_field(const Model& model, const Tissue& tissue, std::size_t field, std::span<const std::size_t> rows,
                                             std::span<const Vec3d> center, const Comm& comm);

/// What the cells of this rank sense of the fields that their migration looks at, by row, at present positions (`center`, by row). Collective.
Result<std::vector<SensedField>> sense_fields(const Model& model, const Tissue& tissue, std::span<const Vec3d> center, const Comm& comm);

}  // namespace morula
