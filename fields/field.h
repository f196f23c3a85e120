#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel/comm.h"
#include "core/result.h"
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
  /// Volume of a voxel [µm³]; all voxels are equal.
  [[nodiscard]] double voxel_volume() const {
    const Vec3d h = spacing();
    return h.x * h.y * h.z;
  }
  [[nodiscard]] std::int64_t voxel_count() const { return std::int64_t{voxels[0]} * voxels[1] * voxels[2]; }
  [[nodiscard]] std::int64_t brick_count() const { return std::int64_t{bricks[0]} * bricks[1] * bricks[2]; }
  /// Place of a brick along x, y, z.
  [[nodiscard]] std::array<std::int32_t, 3> place(std::int64_t brick) const;
  [[nodiscard]] std::int64_t brick_at(const std::array<std::int32_t, 3>& place) const;
  /// Voxels along x, y, z of a brick: 8, or fewer at the high faces.
  [[nodiscard]] std::array<std::int32_t, 3> extent(std::int64_t brick) const;
  /// Centre of a voxel given by its place in the whole grid [µm].
  [[nodiscard]] Vec3d voxel_center(const std::array<std::int32_t, 3>& voxel) const;
};

/// One concentration on this rank: the bricks it owns. Plain data; a checkpoint writes it as it is.
struct Field {
  Grid grid;
  std::vector<std::int64_t> owned_bricks;          ///< brick numbers (x fastest), increasing
  std::vector<std::vector<double>> concentration;  ///< by owned brick, voxels x fastest [mM]
  std::vector<int> owner;                          ///< rank that owns it, by brick of the grid. All ranks hold equal copies.
  double next_step = 0.0;                          ///< the integrator's first step in the next interval [s]; 0: let it choose
  double time = 0.0;                               ///< up to which it is integrated [s]
  double interval = 0.0;                           ///< that the next integration may span [s]; 0: the shortest there is
  double way = 0.0;                                ///< that a point of a cell may have gone since `time` [µm]
};

/// The grid of a field: voxels of about the wanted size, never larger, that divide the domain evenly.
/// Errors: a voxel size that is not positive, an empty domain, more than 2³¹ voxels along an axis.
Result<Grid> grid_for(const FieldSpec& spec, const Space& space);

/// Owners of all bricks: contiguous ranges along the Z-order curve, of equal numbers of bricks (± 1).
std::vector<int> owners_along_curve(const Grid& grid, int ranks);

/// The field at the start: the spec's initial concentration everywhere, on the bricks that `owner_of_brick` gives to `rank`.
Field uniform_field(const Grid& grid, double concentration, std::span<const int> owner_of_brick, int rank);

/// Move bricks so that each is on its new owner. Collective; values are unchanged bit for bit.
void redistribute(Field& field, std::span<const int> new_owner, const Comm& comm);

/// Whether this rank owns just the bricks that Field::owner gives to it.
bool owns_its_bricks(const Field& field, int rank);

/// Amount in the whole field, Σ c V [amol]. Collective; the same bits on any number of ranks.
double total_amount(const Field& field, const Comm& comm);

}  // namespace morula::fields
