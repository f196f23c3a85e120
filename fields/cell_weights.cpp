#include "fields/cell_weights.h"

#include <algorithm>
#include <cmath>

namespace morula::fields {

namespace {

constexpr int kPoints = 4;  ///< per voxel and axis

/// The voxel's number after periodic wrapping, or -1 outside the domain.
std::int32_t wrapped(std::int64_t i, std::int32_t n, bool periodic) {
  if (periodic) return static_cast<std::int32_t>(((i % n) + n) % n);
  return i < 0 || i >= n ? -1 : static_cast<std::int32_t>(i);
}

struct Spreader {
  const Grid& grid;
  const Space& space;
  std::vector<VoxelWeight>& out;

  void add(const std::array<std::int64_t, 3>& at, double weight) {
    std::array<std::int32_t, 3> v{}, place{}, inside{};
    for (std::size_t a = 0; a < 3; ++a) {
      v[a] = wrapped(at[a], grid.voxels[a], space.periodic(static_cast<int>(a)));
      if (v[a] < 0) return;
      place[a] = v[a] / Grid::kBrick;
      inside[a] = v[a] % Grid::kBrick;
    }
    const std::int64_t brick = grid.brick_at(place);
    const auto n = grid.extent(brick);
    out.push_back({brick, inside[0] + n[0] * (inside[1] + n[1] * inside[2]), weight});
  }
};

/// Number of sample points of a voxel inside the sphere.
int points_inside(const Vec3d& corner, const Vec3d& h, const Vec3d& center, double radius) {
  int count = 0;
  std::array<std::array<double, kPoints>, 3> square{};
  for (std::size_t a = 0; a < 3; ++a)
    for (int i = 0; i < kPoints; ++i) {
      const double d = corner[a] + (i + 0.5) / kPoints * h[a] - center[a];
      square[a][static_cast<std::size_t>(i)] = d * d;
    }
  for (const double z : square[2])
    for (const double y : square[1])
      for (const double x : square[0]) count += x + y + z <= radius * radius ? 1 : 0;
  return count;
}

void spread_volume(Spreader& spread, const Vec3d& center, double radius) {
  const Vec3d h = spread.grid.spacing(), low = spread.grid.box.low;
  std::array<std::int64_t, 3> first{}, last{};
  for (std::size_t a = 0; a < 3; ++a) {
    first[a] = static_cast<std::int64_t>(std::floor((center[a] - radius - low[a]) / h[a]));
    last[a] = static_cast<std::int64_t>(std::floor((center[a] + radius - low[a]) / h[a]));
  }
  std::array<std::int64_t, 3> v{};
  for (v[2] = first[2]; v[2] <= last[2]; ++v[2])
    for (v[1] = first[1]; v[1] <= last[1]; ++v[1])
      for (v[0] = first[0]; v[0] <= last[0]; ++v[0]) {
        const Vec3d corner{low.x + static_cast<double>(v[0]) * h.x, low.y + static_cast<double>(v[1]) * h.y,
                           low.z + static_cast<double>(v[2]) * h.z};
        const int count = points_inside(corner, h, center, radius);
        if (count > 0) spread.add(v, count);
      }
}

void spread_trilinear(Spreader& spread, const Vec3d& center) {
  const Vec3d h = spread.grid.spacing(), low = spread.grid.box.low;
  std::array<std::int64_t, 3> base{};
  std::array<double, 3> part{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double s = (center[a] - low[a]) / h[a] - 0.5;
    base[a] = static_cast<std::int64_t>(std::floor(s));
    part[a] = s - std::floor(s);
  }
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    std::array<std::int64_t, 3> v = base;
    for (std::size_t a = 0; a < 3; ++a) {
      const bool high = ((corner >> a) & 1) != 0;
      weight *= high ? part[a] : 1.0 - part[a];
      v[a] += high ? 1 : 0;
    }
    if (weight > 0.0) spread.add(v, weight);
  }
}

void merge_equal_voxels(std::vector<VoxelWeight>& weights) {
  std::stable_sort(weights.begin(), weights.end(),
                   [](const VoxelWeight& a, const VoxelWeight& b) { return a.brick != b.brick ? a.brick < b.brick : a.voxel < b.voxel; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (kept > 0 && weights[kept - 1].brick == weights[i].brick && weights[kept - 1].voxel == weights[i].voxel)
      weights[kept - 1].weight += weights[i].weight;
    else
      weights[kept++] = weights[i];
  }
  weights.resize(kept);
}

void normalize(std::vector<VoxelWeight>& weights) {
  double sum = 0.0;
  for (const auto& w : weights) sum += w.weight;
  for (auto& w : weights) w.weight /= sum;
  auto& largest =
      *std::max_element(weights.begin(), weights.end(), [](const VoxelWeight& a, const VoxelWeight& b) { return a.weight < b.weight; });
  for (int round = 0; round < 4; ++round) {
    double total = 0.0;
    for (const auto& w : weights) total += w.weight;
    if (total == 1.0) break;
    largest.weight += 1.0 - total;
  }
}

}  // namespace

void sphere_weights(const Grid& grid, const Space& space, const Vec3d& center, double radius, std::vector<VoxelWeight>& out) {
  out.clear();
  Spreader spread{grid, space, out};
  const Vec3d h = grid.spacing();
  if (radius < 0.5 * std::max({h.x, h.y, h.z}))
    spread_trilinear(spread, center);
  else
    spread_volume(spread, center, radius);
  if (out.empty()) {
    std::array<std::int64_t, 3> nearest{};
    for (std::size_t a = 0; a < 3; ++a) {
      const double place = std::clamp((center[a] - grid.box.low[a]) / h[a], 0.0, static_cast<double>(grid.voxels[a]) - 0.5);
      nearest[a] = static_cast<std::int64_t>(place);
    }
    spread.add(nearest, 1.0);
  }
  merge_equal_voxels(out);
  normalize(out);
}

}  // namespace morula::fields
