#include "study/initial/scatter_densely.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/ball.h"
#include "core/random/philox.h"
#include "study/initial/part_many.h"

namespace morula::scenarios {
namespace {

constexpr std::uint64_t kFirstDraw = std::uint64_t{1} << 40;  // of the first founder; lower ones are those of other patterns
constexpr std::uint64_t kDrawsOfCube = 3;
constexpr int kMostTries = 200;  // of lattices with ever smaller cubes
constexpr double kNext = 0.9;    // of the width of cubes none of which lay within the shape
constexpr double kInset = 0.9;   // of the mean radius: so near to the border do the cubes' middles begin
constexpr int kMostPasses = 400;

double volume_of(const InitialCells& block) {
  if (block.fill == FillShape::kSphere) return ball_volume(block.radius);
  return block.size.x * block.size.y * block.size.z;
}

struct Cube {
  std::uint64_t number;  ///< in the lattice
  Vec3d middle;
};

/// The cubes of this width whose middle lies in the shape, beside what is there.
std::vector<Cube> cubes_within(const InitialCells& block, double width, double mean, const Space& space, const Surroundings& around) {
  const bool sphere = block.fill == FillShape::kSphere;
  std::array<std::int64_t, 3> most{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    most[axis] = static_cast<std::int64_t>((sphere ? block.radius : 0.5 * block.size[axis]) / width) + 1;
  std::vector<Cube> out;
  std::uint64_t number = 0;
  for (std::int64_t k = -most[2]; k < most[2]; ++k)
    for (std::int64_t j = -most[1]; j < most[1]; ++j)
      for (std::int64_t i = -most[0]; i < most[0]; ++i, ++number) {
        const Vec3d from = Vec3d{static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5, static_cast<double>(k) + 0.5} * width;
        if (!within(block, from, kInset * mean)) continue;
        const Vec3d p = block.center + from;
        Vec3d ignored;
        if (!around.empty() && around.push(p, kInset * mean, 1.0, ignored) > 0.0) continue;
        out.push_back({number, space.wrapped(p)});
      }
  return out;
}

}  // namespace

double filled_part(const InitialCells& block, std::span<const double> radius) {
  double cubes = 0.0;
  for (const double r : radius) cubes += r * r * r;
  return 4.0 / 3.0 * std::numbers::pi * cubes / volume_of(block);
}

bool within(const InitialCells& block, const Vec3d& from_center, double inset) {
  if (block.fill == FillShape::kSphere) return norm(from_center) <= block.radius - inset;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::abs(from_center[axis]) > 0.5 * block.size[axis] - inset) return false;
  return true;
}

Packing scatter_densely(const InitialCells& block, std::span<const double> radius, double touch, const Space& space,
                        std::uint64_t first_number, std::uint32_t seed, const Surroundings& around, int threads) {
  Packing out;
  const double mean = mean_radius(radius);
  const auto count = static_cast<double>(radius.size());
  double width = std::cbrt(volume_of(block) / count);
  std::vector<Cube> cubes;
  for (int tries = 0; tries < kMostTries && width > 0.5 * mean; ++tries) {
    cubes = cubes_within(block, width, mean, space, around);
    if (cubes.size() >= radius.size()) break;
    width *= cubes.empty() ? kNext : std::min(0.995, std::cbrt(static_cast<double>(cubes.size()) / count));
  }
  out.room = std::min(cubes.size(), radius.size());
  if (out.room < radius.size()) return out;

  const Random random(seed, RandomStream::kInitialPosition);
  const CellId id = CellId::founder(first_number);
  const auto draws = [&](const Cube& cube, std::uint64_t draw) {
    return random.uniform(id, kFirstDraw + kDrawsOfCube * cube.number + draw);
  };
  // Cubes beyond the number of cells stay empty, drawn by lot.
  std::vector<std::pair<double, std::size_t>> lots;
  for (std::size_t k = 0; k < cubes.size(); ++k) lots.emplace_back(draws(cubes[k], 0).first, k);
  std::nth_element(lots.begin(), lots.begin() + static_cast<std::ptrdiff_t>(radius.size() - 1), lots.end());
  lots.resize(radius.size());
  std::sort(lots.begin(), lots.end());  // cells of a mixture are numbered in an order of their own, so that any order does
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const Cube& cube = cubes[lots[i].second];
    const RandomPair a = draws(cube, 1), b = draws(cube, 2);
    Vec3d p = cube.middle + Vec3d{a.first - 0.5, a.second - 0.5, b.first - 0.5} * width;
    keep_within_walls(p, radius[i], space);
    out.center.push_back(p);
  }
  out.allowed_overlap = slack_of_many(touch, mean);
  const PartMany how{.slack = out.allowed_overlap, .most_passes = kMostPasses, .within = &block, .around = &around, .threads = threads};
  const Parted parted = part_many(out.center, radius, how, space);
  out.worst_overlap = parted.overlap;
  out.worst_intrusion = parted.intrusion;
  out.reach_beyond = parted.beyond;
  out.jammed = std::max({parted.overlap, parted.intrusion, parted.beyond}) > how.slack;
  return out;
}

}  // namespace morula::scenarios
