#include "study/initial/packing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random/philox.h"
#include "core/random/rotation.h"
#include "study/initial/cell_grid.h"
#include "study/initial/part_many.h"

namespace morula::scenarios {
namespace {

constexpr double kJitter = 0.03;          // of the spacing
constexpr double kSmallestSpacing = 0.9;  // of the wanted spacing, before cells stick out of the shape
constexpr int kMostPasses = 400;
constexpr double kDraw = 0.01;   // part of the way to the middle in the first pass
constexpr double kSlack = 1e-3;  // of the mean radius
constexpr double kSlackOfMany = 0.05, kSlackOfManyShells = 0.02;
constexpr double kWiden =
    0.6;  // of the spread of the radii: so much wider is the lattice of many cells that come apart in some fifty passes

/// How far out a point lies in the shape: 1 on the border where centres end.
double gauge(const InitialCells& block, const Vec3d& from_center, double inset) {
  if (block.fill == FillShape::kSphere) return norm(from_center) / std::max(block.radius - inset, 0.05 * block.radius);
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
  const bool sphere = block.fill == FillShape::kSphere;
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

/// Sites, the innermost first, and whether all that the shape has were free.
struct ChosenSites {
  std::vector<Site> sites;
  bool all_free = true;
};

/// The `count` innermost free sites, with the largest spacing that lets them lie within the shape; fewer where what is around leaves no room.
template <class IsFree>
ChosenSites choose_sites(const InitialCells& block, std::size_t count, double spacing, double inset, const Rotation& turn,
                         IsFree&& is_free) {
  ChosenSites out;
  std::size_t all = 0;  // free or not
  const auto look = [&](double part, double most) {
    out.sites = lattice_sites(block, part * spacing, inset, most, turn);
    all = out.sites.size();
    std::erase_if(out.sites, [&](const Site& site) { return !is_free(block.center + site.position); });
    out.all_free = out.sites.size() == all;
  };
  for (double part = 1.0; part > kSmallestSpacing - 1e-9; part -= 0.02) {
    look(part, 1.0);
    if (out.sites.size() >= count) break;
  }
  for (double most = 1.05; all < count; most *= 1.05) look(kSmallestSpacing, most);
  std::stable_sort(out.sites.begin(), out.sites.end(), [](const Site& a, const Site& b) { return a.gauge < b.gauge; });
  out.sites.resize(std::min(count, out.sites.size()));
  return out;
}

/// Standard deviation of the radii over their mean.
double spread_of(std::span<const double> radius) {
  double sum = 0.0, squares = 0.0;
  for (const double r : radius) {
    sum += r;
    squares += r * r;
  }
  const auto count = static_cast<double>(radius.size());
  return std::sqrt(std::max(squares / count - sum * sum / (count * count), 0.0)) * count / sum;
}

/// How far the outermost cell reaches out of the shape [µm].
double beyond_shape(const InitialCells& block, std::span<const Vec3d> center, std::span<const double> radius) {
  double most = 0.0;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const Vec3d from = center[i] - block.center;
    double beyond = norm(from) + radius[i] - block.radius;
    if (block.fill == FillShape::kBox) {
      beyond = -1e300;
      for (std::size_t axis = 0; axis < 3; ++axis) beyond = std::max(beyond, std::abs(from[axis]) + radius[i] - 0.5 * block.size[axis]);
    }
    most = std::max(most, beyond);
  }
  return most;
}

}  // namespace

double lattice_spacing(std::span<const double> radius, double touch) {
  return 2.0 * mean_radius(radius) * (radius.size() >= kMany ? 1.0 + kWiden * spread_of(radius) : touch);
}

double slack_of_many(double touch, double mean_radius) { return (touch < 1.0 ? kSlackOfMany : kSlackOfManyShells) * mean_radius; }

void keep_within_walls(Vec3d& p, double radius, const Space& space) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = space.box.low[axis] + radius, high = space.box.high[axis] - radius;
    if (low > high) continue;
    if (space.boundary[axis][0] == BoundaryKind::kWall) p[axis] = std::max(p[axis], low);
    if (space.boundary[axis][1] == BoundaryKind::kWall) p[axis] = std::min(p[axis], high);
  }
  p = space.wrapped(p);
}

double mean_radius(std::span<const double> radius) {
  double cubes = 0.0;
  for (const double r : radius) cubes += r * r * r;
  return std::cbrt(cubes / static_cast<double>(radius.size()));
}

double push_apart(std::vector<Vec3d>& center, std::span<const double> radius, const PushApart& how, const Space& space,
                  double* worst_intrusion) {
  if (center.empty()) return 0.0;
  const double reach = 2.0 * how.touch * *std::max_element(radius.begin(), radius.end());
  const bool beside = how.around && !how.around->empty();
  std::vector<Vec3d> push(center.size());
  double worst = -1e300, intrusion = -1e300;
  for (int pass = 0; pass <= how.most_passes; ++pass) {
    const CellGrid grid(center, reach, space);
    worst = intrusion = -1e300;
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
      if (!beside) continue;
      Vec3d out{};
      intrusion = std::max(intrusion, how.around->push(center[i], radius[i], how.touch, out));
      push[i] += out * 0.8;  // what is there does not move
    }
    const double draw = pass < how.drawn_passes ? kDraw * (1.0 - static_cast<double>(pass) / how.drawn_passes) : 0.0;
    if ((std::max(worst, intrusion) <= how.slack && draw == 0.0) || pass == how.most_passes) break;
    for (std::size_t i = 0; i < center.size(); ++i) {
      center[i] += push[i] + (how.middle - center[i]) * draw;
      if (how.plane) center[i] += how.plane->normal * (radius[i] - dot(center[i] - how.plane->point, how.plane->normal));
      keep_within_walls(center[i], radius[i], space);
    }
  }
  if (worst_intrusion) *worst_intrusion = intrusion;
  return worst;
}

Packing pack_cells(const InitialCells& block, std::span<const double> radius, double touch, const Space& space, std::uint64_t first_number,
                   std::uint32_t seed, const Surroundings& around, int threads) {
  Packing out;
  if (radius.empty()) return out;
  const Random random(seed, RandomStream::kInitialPosition);
  const double mean = mean_radius(radius);
  const bool many = radius.size() >= kMany;
  const double spacing = lattice_spacing(radius, touch);
  const Rotation turn = random_rotation(random, CellId::founder(first_number), 0);
  const auto is_free = [&](const Vec3d& p) {
    Vec3d ignored;
    return around.empty() || around.push(p, mean, touch, ignored) <= 0.0;
  };
  const auto [sites, all_free] = choose_sites(block, radius.size(), spacing, mean, turn, is_free);
  out.room = sites.size();
  if (out.room < radius.size()) return out;
  Vec3d middle{};
  if (all_free) {
    for (const Site& site : sites) middle += site.position;
    middle *= 1.0 / static_cast<double>(sites.size());
  }
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const CellId id = CellId::founder(first_number + i);
    const Vec3d jitter = random.direction(id, 2) * (kJitter * spacing * random.uniform(id, 3).first);
    Vec3d p = block.center + (sites[i].position - middle) + (radius.size() > 1 ? jitter : Vec3d{});
    keep_within_walls(p, radius[i], space);
    out.center.push_back(p);
  }
  if (many) {
    out.allowed_overlap = slack_of_many(touch, mean);
    const Parted parted = part_many(out.center, radius, {.slack = out.allowed_overlap, .around = &around, .threads = threads}, space);
    out.worst_overlap = parted.overlap;
    out.worst_intrusion = parted.intrusion;
  } else {
    const int drawn = block.fill == FillShape::kSphere && !space.any_periodic() && radius.size() > 1 ? kMostPasses / 3 : 0;
    const PushApart how{touch, kSlack * mean, kMostPasses, drawn, block.center, &around, nullptr};
    out.worst_overlap = push_apart(out.center, radius, how, space, &out.worst_intrusion);
  }
  out.reach_beyond = beyond_shape(block, out.center, radius);
  return out;
}

}  // namespace morula::scenarios
