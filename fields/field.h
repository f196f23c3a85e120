#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/space/space.h"
#include "core/vec3.h"
#include "fields/field_spec.h"

namespace morula::fields {

/// The voxels of the domain, cut into bricks. The same for every field of the same voxel size, on every rank.
struct Grid {
  Box box;
  std::array<std::int32_t, 3> voxels{};      ///< along x, y, z
  std::array<std::int32_t, 3> bricks{};      ///< along x, y, z
  static constexpr std::int32_t kBrick = 8;  ///< voxels along a side of a brick (fewer at the high faces)

  [[nodiscard]] Vec3d spacing() const {
    const Vec3d size = box.size();
    return {size.x / voxels[0], size.y / voxels[1], size.z / voxels[2]};
  }
  [[nodiscard]] std::int64_t brick_count() const { return std::int64_t{bricks[0]} * bricks[1] * bricks[2]; }
};

/// One concentration on this rank: the bricks it owns.
struct Field {
  Grid grid;
  std::vector<std::int64_t> owned_bricks;          ///< brick numbers (x fastest), increasing
  std::vector<std::vector<double>> concentration;  ///< by owned brick, voxels x fastest [mM]
  double next_step = 0.0;                          ///< the integrator's first step in the next interval [s]; 0: let it choose
};

}  // namespace morula::fields
