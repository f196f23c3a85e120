#include "scenarios/initial/packing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/random/philox.h"
#include "core/random/rotation.h"

namespace morula::scenarios {
namespace {

constexpr double kJitter = 0.03;          // of the spacing
constexpr double kSmallestSpacing = 0.9;  // of the wanted spacing, before cells stick out of the shape
constexpr int kMostPasses = 400;          // fewer for very many cells
constexpr double kCellPasses = 4e7;
constexpr double kDraw = 0.01;   // part of the way to the middle in the first pass
constexpr double kSlack = 1e-3;  // of the mean radius

/// How far out a point lies in the shape: 1 on the border where centres end.
double gauge(const InitialCells& block, const Vec3d& from_center, double inset) {
  if (block.fill == RegionShape::kSphere) return norm(from_center) / std::max(block.radius - inset, 0.05 * block.radius);
  double out = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    out = std::max(out, std::abs(from_center[axis]) / std::max(0.5 * block.size[axis] - inset, 0.05 * block.size[axis]));
  return out;
}

struct Site {
  double gauge;
  Vec3d position;  ///< from the centre
};

/// All lattice points with a gauge of at most `most`, in the order of the lattice.
std::vector<Site> lattice_sites(const InitialCells& block, double spacing, double inset, double most, const Rotation& turn) {
  const bool sphere = block.fill == RegionShape::kSphere;
  Vec3d half;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double reach = sphere ? block.radius : 0.5 * block.size[axis];
    half[axis] = most * std::max(reach - inset, 0.1 * reach);
  }
  const double step = spacing / std::numbers::sqrt2;  // points of even i + j + k, nearest neighbours a spacing apart
  const auto count = [&](std::size_t axis) { return static_cast<std::int64_t>(std::floor(half[axis] / step + 1e-9)); };
  std::vector<Site> sites;
  for (std::int64_t k = -count(2); k <= count(2); ++k)
    for (std::int64_t j = -count(1); j <= count(1); ++j)
      for (std::int64_t i = -count(0); i <= count(0); ++i) {
        if ((i + j + k) % 2 != 0) continue;
        const Vec3d p{static_cast<double>(i) * step, static_cast<double>(j) * step, static_cast<double>(k) * step};
        const double g = gauge(block, p, inset);
        if (g <= most) sites.push_back({g, sphere ? turn * p : p});
      }
  return sites;
}

/// The `count` innermost sites, with the largest spacing that lets them lie within the shape.
std::vector<Site> choose_sites(const InitialCells& block, std::size_t count, double spacing, double inset, const Rotation& turn) {
  std::vector<Site> sites;
  for (double part = 1.0; part > kSmallestSpacing - 1e-9; part -= 0.02) {
    sites = lattice_sites(block, part * spacing, inset, 1.0, turn);
    if (sites.size() >= count) break;
  }
  for (double most = 1.05; sites.size() < count; most *= 1.05) sites = lattice_sites(block, kSmallestSpacing * spacing, inset, most, turn);
  std::stable_sort(sites.begin(), sites.end(), [](const Site& a, const Site& b) { return a.gauge < b.gauge; });
  sites.resize(count);
  return sites;
}

/// Cells sorted into cubes that are as large as the longest distance that matters.
class CellGrid {
 public:
  CellGrid(const std::vector<Vec3d>& center, double reach, const Space& space) {
    Box box;
    for (const Vec3d& c : center) box.include(c);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      periodic_[axis] = space.periodic(static_cast<int>(axis));
      low_[axis] = periodic_[axis] ? space.box.low[axis] : box.low[axis];
      const double size = (periodic_[axis] ? space.box.high[axis] : box.high[axis]) - low_[axis];
      count_[axis] = std::clamp<std::int64_t>(static_cast<std::int64_t>(size / reach), 1, 1024);
      width_[axis] = std::max(size / static_cast<double>(count_[axis]), reach);
    }
    first_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]) + 1, 0);
    cube_.resize(center.size());
    for (std::size_t i = 0; i < center.size(); ++i) ++first_[(cube_[i] = number(place(center[i]))) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    item_.resize(center.size());
    for (std::size_t i = 0; i < center.size(); ++i) item_[next[cube_[i]]++] = i;
  }

  /// function(j) for every cell j near to a point, each once, in an order that depends on the positions alone.
  template <class F>
  void near(const Vec3d& point, F&& function) const {
    const auto at = place(point);
    std::array<std::array<std::int64_t, 3>, 3> along{};
    std::array<int, 3> used{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::int64_t d = -1; d <= 1; ++d) {
        std::int64_t p = at[axis] + d;
        if (periodic_[axis]) p = (p + count_[axis]) % count_[axis];
        if (p < 0 || p >= count_[axis]) continue;
        auto& list = along[axis];
        const auto end = list.begin() + used[axis];
        if (std::find(list.begin(), end, p) == end) list[static_cast<std::size_t>(used[axis]++)] = p;
      }
    for (int z = 0; z < used[2]; ++z)
      for (int y = 0; y < used[1]; ++y)
        for (int x = 0; x < used[0]; ++x) {
          const auto cube =
              number({along[0][static_cast<std::size_t>(x)], along[1][static_cast<std::size_t>(y)], along[2][static_cast<std::size_t>(z)]});
          for (std::size_t k = first_[cube]; k < first_[cube + 1]; ++k) function(item_[k]);
        }
  }

 private:
  [[nodiscard]] std::array<std::int64_t, 3> place(const Vec3d& p) const {
    std::array<std::int64_t, 3> out{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      out[axis] =
          std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor((p[axis] - low_[axis]) / width_[axis])), 0, count_[axis] - 1);
    return out;
  }
  [[nodiscard]] std::size_t number(const std::array<std::int64_t, 3>& p) const {
    return static_cast<std::size_t>((p[2] * count_[1] + p[1]) * count_[0] + p[0]);
  }

  Vec3d low_, width_;
  std::array<bool, 3> periodic_{};
  std::array<std::int64_t, 3> count_{};
  std::vector<std::size_t> first_, cube_, item_;
};

void keep_within_walls(Vec3d& p, double radius, const Space& space) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = space.box.low[axis] + radius, high = space.box.high[axis] - radius;
    if (low > high) continue;
    if (space.boundary[axis][0] == BoundaryKind::kWall) p[axis] = std::max(p[axis], low);
    if (space.boundary[axis][1] == BoundaryKind::kWall) p[axis] = std::min(p[axis], high);
  }
  p = space.wrapped(p);
}

}  // namespace

double push_apart(std::vector<Vec3d>& center, std::span<const double> radius, const PushApart& how, const Space& space) {
  if (center.empty()) return 0.0;
  const double reach = 2.0 * how.touch * *std::max_element(radius.begin(), radius.end());
  std::vector<Vec3d> push(center.size());
  double worst = -1e300;
  for (int pass = 0; pass <= how.most_passes; ++pass) {
    const CellGrid grid(center, reach, space);
    worst = -1e300;
    for (std::size_t i = 0; i < center.size(); ++i) {
      push[i] = {};
      grid.near(center[i], [&](std::size_t j) {
        if (j == i) return;
        const Vec3d away = space.nearest_image(center[i] - center[j]);
        const double distance = norm(away);
        const double overlap = how.touch * (radius[i] + radius[j]) - distance;
        worst = std::max(worst, overlap);
        // Both move by a little less than half: a cell with many neighbours would overshoot.
        if (overlap > 0.0 && distance > 0.0) push[i] += away * (0.4 * overlap / distance);
      });
    }
    const double draw = pass < how.drawn_passes ? kDraw * (1.0 - static_cast<double>(pass) / how.drawn_passes) : 0.0;
    if ((worst <= how.slack && draw == 0.0) || pass == how.most_passes) break;
    for (std::size_t i = 0; i < center.size(); ++i) {
      center[i] += push[i] + (how.middle - center[i]) * draw;
      keep_within_walls(center[i], radius[i], space);
    }
  }
  return worst;
}

Packing pack_cells(const InitialCells& block, std::span<const double> radius, double touch, const Space& space, std::uint64_t first_number,
                   std::uint32_t seed) {
  Packing out;
  if (radius.empty()) return out;
  const Random random(seed, RandomStream::kInitialPosition);
  double cubes = 0.0;
  for (const double r : radius) cubes += r * r * r;
  const double mean = std::cbrt(cubes / static_cast<double>(radius.size()));
  const double spacing = 2.0 * touch * mean;
  const Rotation turn = random_rotation(random, CellId::founder(first_number), 0);
  const auto sites = choose_sites(block, radius.size(), spacing, mean, turn);
  Vec3d middle{};
  for (const Site& site : sites) middle += site.position;
  middle *= 1.0 / static_cast<double>(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const CellId id = CellId::founder(first_number + i);
    const Vec3d jitter = random.direction(id, 2) * (kJitter * spacing * random.uniform(id, 3).first);
    Vec3d p = block.center + (sites[i].position - middle) + (radius.size() > 1 ? jitter : Vec3d{});
    keep_within_walls(p, radius[i], space);
    out.center.push_back(p);
  }
  const int passes = std::clamp(static_cast<int>(kCellPasses / static_cast<double>(radius.size())), 60, kMostPasses);
  const int drawn = block.fill == RegionShape::kSphere && !space.any_periodic() && radius.size() > 1 ? passes / 3 : 0;
  out.worst_overlap = push_apart(out.center, radius, {touch, kSlack * mean, passes, drawn, block.center}, space);
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const Vec3d from = out.center[i] - block.center;
    double beyond = norm(from) + radius[i] - block.radius;
    if (block.fill == RegionShape::kBox) {
      beyond = -1e300;
      for (std::size_t axis = 0; axis < 3; ++axis) beyond = std::max(beyond, std::abs(from[axis]) + radius[i] - 0.5 * block.size[axis]);
    }
    out.reach_beyond = std::max(out.reach_beyond, beyond);
  }
  return out;
}

}  // namespace morula::scenarios
