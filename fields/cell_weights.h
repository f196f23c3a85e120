#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/space/space.h"
#include "core/vec3.h"
#include "fields/field.h"

namespace morula::fields {

/// The part of a cell that lies in a voxel.
struct VoxelWeight {
  std::int64_t brick = 0;  ///< in the grid
  std::int32_t voxel = 0;  ///< in the brick, x fastest
  double weight = 0.0;
};

/// How a sphere is spread over the voxels: w_v ≥ 0, Σ w_v = 1; sorted by (brick, voxel), each voxel once.
///
/// w_v is the share of the sphere's volume in the voxel, along lines parallel to z, at least four per voxel and axis and twelve across the sphere, whose
/// lengths inside are exact. A sphere with a radius of less than half a voxel has the trilinear weights of its centre, between that and a whole one
/// w_v goes over from these to the shares of the volume: what a cell sees of a linear field is that at its centre, within 0.03 voxels along each axis, and nothing jumps where it grows. What lies beyond a face that is not periodic is given to the part inside; a cell that is wholly outside
/// belongs to the nearest voxel. The round-off of the sum goes to the largest weight (physics: fields_and_coupling.md, A).
/// `out` is overwritten.
void sphere_weights(const Grid& grid, const Space& space, const Vec3d& center, double radius, std::vector<VoxelWeight>& out);

/// The same of what a closed surface with outward faces encloses, whatever its shape; its radius is that of a ball of its volume. The lines belong to the
/// grid, so that a cell that does not move keeps its weights to the last bit. `center`: its centroid.
void surface_weights(const Grid& grid, const Space& space, const Vec3d& center, std::span<const Triangle> faces,
                     std::span<const Vec3d> nodes, std::vector<VoxelWeight>& out);

}  // namespace morula::fields
