#include "fields/cell_weights.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/ball.h"

namespace morula::fields {

namespace {

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

/// Weights of a sum `total`.
void spread_trilinear(Spreader& spread, const Vec3d& center, double total) {
  const Vec3d h = spread.grid.spacing(), low = spread.grid.box.low;
  std::array<std::int64_t, 3> base{};
  std::array<double, 3> part{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double s = (center[a] - low[a]) / h[a] - 0.5;
    base[a] = static_cast<std::int64_t>(std::floor(s));
    part[a] = s - std::floor(s);
  }
  for (int corner = 0; corner < 8; ++corner) {
    double weight = total;
    std::array<std::int64_t, 3> v = base;
    for (std::size_t a = 0; a < 3; ++a) {
      const bool high = ((corner >> a) & 1) != 0;
      weight *= high ? part[a] : 1.0 - part[a];
      v[a] += high ? 1 : 0;
    }
    if (weight > 0.0) spread.add(v, weight);
  }
}

constexpr double kLinesAcross = 12.0;   ///< sample lines across the least width of a cell
constexpr int kFewest = 4, kMost = 64;  ///< sample lines per voxel and axis

/// Where a sample line along z goes into a closed surface (sign 1) or comes out of it (−1).
struct Crossing {
  std::int64_t line = 0;
  double z = 0.0;
  int sign = 0;
};

/// Whether (x, y) lies to the left of the way from node i to node j. Both faces of an edge agree about it, also for points on the edge, so that a line
/// that goes into a closed surface comes out of it.
bool is_left(std::span<const Vec3d> nodes, std::uint32_t i, std::uint32_t j, double x, double y) {
  const Vec3d &a = nodes[std::min(i, j)], &b = nodes[std::max(i, j)];
  const bool left = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) >= 0.0;
  return i < j ? left : !left;
}

/// Sample lines along z through a grid of voxels: `count` per voxel along x and y, at the middles of equal parts.
struct SampleLines {
  Vec3d low, h;
  std::array<int, 2> count;
  std::array<std::int64_t, 2> first{}, number{};  ///< of the lines that may meet the surface

  [[nodiscard]] double place(std::size_t axis, std::int64_t i) const {
    return low[axis] + (static_cast<double>(first[axis] + i) + 0.5) * h[axis] / count[axis];
  }
  [[nodiscard]] std::int64_t voxel(std::size_t axis, std::int64_t i) const {
    return static_cast<std::int64_t>(std::floor((static_cast<double>(first[axis] + i) + 0.5) / count[axis]));
  }
  /// First of the lines at or beyond a place, from 0 to `number`.
  [[nodiscard]] std::int64_t from(std::size_t axis, double at) const {
    const double line = std::ceil((at - low[axis]) * count[axis] / h[axis] - 0.5);
    return std::clamp(static_cast<std::int64_t>(line) - first[axis], std::int64_t{0}, number[axis]);
  }
};

SampleLines lines_through(const Grid& grid, const Vec3d& least, const Vec3d& most) {
  SampleLines out{grid.box.low, grid.spacing(), {}, {}, {}};
  const double width = std::min(most.x - least.x, most.y - least.y);
  for (std::size_t a = 0; a < 2; ++a) {
    const double wanted = std::ceil(out.h[a] * kLinesAcross / std::max(width, 1e-300));
    out.count[a] = static_cast<int>(std::clamp(wanted, double{kFewest}, double{kMost}));
    out.first[a] = static_cast<std::int64_t>(std::floor((least[a] - out.low[a]) * out.count[a] / out.h[a])) - 1;
    out.number[a] = static_cast<std::int64_t>(std::ceil((most[a] - out.low[a]) * out.count[a] / out.h[a])) + 1 - out.first[a];
  }
  return out;
}

std::vector<Crossing> crossings_of(const SampleLines& lines, std::span<const Triangle> faces, std::span<const Vec3d> nodes) {
  std::vector<Crossing> out;
  for (const Triangle& t : faces) {
    const Vec3d &a = nodes[t[0]], &b = nodes[t[1]], &c = nodes[t[2]];
    const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
    const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    const Vec3d normal = cross(b - a, c - a);
    for (std::int64_t j = lines.from(1, low_y); j < lines.number[1] && lines.place(1, j) <= high_y; ++j)
      for (std::int64_t i = lines.from(0, low_x); i < lines.number[0] && lines.place(0, i) <= high_x; ++i) {
        const double x = lines.place(0, i), y = lines.place(1, j);
        const bool left = is_left(nodes, t[0], t[1], x, y);
        if (left != is_left(nodes, t[1], t[2], x, y) || left != is_left(nodes, t[2], t[0], x, y)) continue;
        const double rise = normal.z != 0.0 ? -(normal.x * (x - a.x) + normal.y * (y - a.y)) / normal.z : 0.0;
        out.push_back(
            {j * lines.number[0] + i, std::clamp(a.z + rise, std::min({a.z, b.z, c.z}), std::max({a.z, b.z, c.z})), left ? -1 : 1});
      }
  }
  std::sort(out.begin(), out.end(),
            [](const Crossing& p, const Crossing& q) { return std::tie(p.line, p.z, p.sign) < std::tie(q.line, q.z, q.sign); });
  return out;
}

/// Lengths of sample lines inside a cell, by voxel of the box of those that it meets [voxels].
class InsideLengths {
 public:
  InsideLengths(const SampleLines& lines, const Vec3d& least, const Vec3d& most) : lines_(lines) {
    for (std::size_t a = 0; a < 3; ++a) {
      first_[a] = static_cast<std::int64_t>(std::floor((least[a] - lines.low[a]) / lines.h[a]));
      number_[a] = static_cast<std::int64_t>(std::floor((most[a] - lines.low[a]) / lines.h[a])) + 1 - first_[a];
    }
    length_.assign(static_cast<std::size_t>(number_[0] * number_[1] * number_[2]), 0.0);
  }

  /// A line is inside from one z to another; i, j: its numbers among the lines.
  void add(std::int64_t i, std::int64_t j, double low, double high) {
    const std::int64_t x = lines_.voxel(0, i) - first_[0], y = lines_.voxel(1, j) - first_[1];
    const double from = (low - lines_.low.z) / lines_.h.z - static_cast<double>(first_[2]);
    const double to = (high - lines_.low.z) / lines_.h.z - static_cast<double>(first_[2]);
    for (double v = std::max(0.0, std::floor(from)); v < to && v < static_cast<double>(number_[2]); v += 1.0)
      length_[static_cast<std::size_t>((static_cast<std::int64_t>(v) * number_[1] + y) * number_[0] + x)] +=
          std::min(to, v + 1.0) - std::max(from, v);
  }

  /// Weights of a sum `total`, in so far as they lie in the domain.
  void spread(Spreader& spread, double total) const {
    double sum = 0.0;
    for (const double part : length_) sum += part;
    std::size_t k = 0;
    for (std::int64_t z = 0; z < number_[2]; ++z)
      for (std::int64_t y = 0; y < number_[1]; ++y)
        for (std::int64_t x = 0; x < number_[0]; ++x, ++k)
          if (length_[k] > 0.0) spread.add({first_[0] + x, first_[1] + y, first_[2] + z}, length_[k] * (total / sum));
  }

 private:
  const SampleLines& lines_;
  std::array<std::int64_t, 3> first_{}, number_{};
  std::vector<double> length_;  ///< x fastest
};

void spread_surface(Spreader& spread, const Vec3d& least, const Vec3d& most, std::span<const Triangle> faces, std::span<const Vec3d> nodes,
                    double total) {
  const SampleLines lines = lines_through(spread.grid, least, most);
  const std::vector<Crossing> crossings = crossings_of(lines, faces, nodes);
  InsideLengths lengths(lines, least, most);
  int inside = 0;
  for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
    inside += crossings[k].sign;
    if (crossings[k + 1].line != crossings[k].line) inside = 0;
    if (inside > 0)
      lengths.add(crossings[k].line % lines.number[0], crossings[k].line / lines.number[0], crossings[k].z, crossings[k + 1].z);
  }
  lengths.spread(spread, total);
}

void spread_ball(Spreader& spread, const Vec3d& center, double radius, double total) {
  const Vec3d reach{radius, radius, radius}, least = center - reach, most = center + reach;
  const SampleLines lines = lines_through(spread.grid, least, most);
  InsideLengths lengths(lines, least, most);
  for (std::int64_t j = 0; j < lines.number[1]; ++j)
    for (std::int64_t i = 0; i < lines.number[0]; ++i) {
      const double x = lines.place(0, i) - center.x, y = lines.place(1, j) - center.y, square = radius * radius - x * x - y * y;
      if (square <= 0.0) continue;
      const double half = std::sqrt(square);
      lengths.add(i, j, center.z - half, center.z + half);
    }
  lengths.spread(spread, total);
}

/// How much of a cell is spread by its volume; the rest by the trilinear weights of its centre. From half a voxel to a whole one.
double part_by_volume(const Vec3d& h, double radius) { return std::clamp(2.0 * radius / std::max({h.x, h.y, h.z}) - 1.0, 0.0, 1.0); }

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

/// A cell that is wholly outside belongs to the nearest voxel; then the weights are sorted and normalised.
void finish(Spreader& spread, const Vec3d& center) {
  if (spread.out.empty()) {
    const Grid& grid = spread.grid;
    const Vec3d h = grid.spacing();
    std::array<std::int64_t, 3> nearest{};
    for (std::size_t a = 0; a < 3; ++a) {
      const double place = std::clamp((center[a] - grid.box.low[a]) / h[a], 0.0, static_cast<double>(grid.voxels[a]) - 0.5);
      nearest[a] = static_cast<std::int64_t>(place);
    }
    spread.add(nearest, 1.0);
  }
  merge_equal_voxels(spread.out);
  normalize(spread.out);
}

}  // namespace

void sphere_weights(const Grid& grid, const Space& space, const Vec3d& center, double radius, std::vector<VoxelWeight>& out) {
  out.clear();
  Spreader spread{grid, space, out};
  const double by_volume = part_by_volume(grid.spacing(), radius);
  if (by_volume < 1.0) spread_trilinear(spread, center, 1.0 - by_volume);
  if (by_volume > 0.0) spread_ball(spread, center, radius, by_volume);
  finish(spread, center);
}

void surface_weights(const Grid& grid, const Space& space, const Vec3d& center, std::span<const Triangle> faces,
                     std::span<const Vec3d> nodes, std::vector<VoxelWeight>& out) {
  out.clear();
  Spreader spread{grid, space, out};
  Vec3d least = center, most = center;
  for (const Vec3d& x : nodes)
    for (std::size_t a = 0; a < 3; ++a) least[a] = std::min(least[a], x[a]), most[a] = std::max(most[a], x[a]);
  double volume = 0.0;
  for (const Triangle& t : faces) volume += dot(nodes[t[0]] - center, cross(nodes[t[1]] - center, nodes[t[2]] - center)) / 6.0;
  const double by_volume = part_by_volume(grid.spacing(), ball_radius(std::max(0.0, volume)));
  if (by_volume < 1.0) spread_trilinear(spread, center, 1.0 - by_volume);
  if (by_volume > 0.0) spread_surface(spread, least, most, faces, nodes, by_volume);
  finish(spread, center);
}

}  // namespace morula::fields
