#include "scenarios/experiments/ball_of_cells.h"

#include <cmath>

#include "core/random/philox.h"

namespace morula::scenarios {
namespace {

constexpr auto kStream = static_cast<RandomStream>(0x62616c6c);  // a seed of its own: nothing else draws from it
constexpr double kTouch = 1.99;                                  // distance of centres that touch, in radii
constexpr double kFilled = 0.5;                                  // of the ball that they begin in
constexpr int kRounds = 2000, kSweeps = 8, kLastSweeps = 4000;
constexpr double kDraw = 0.006;    // part of the way to the middle in the first round; less later, none in the last
constexpr double kClear = 1e-4;    // overlap that is left, in radii
constexpr double kRounded = 1e-4;  // of the radius

std::vector<Vec3d> places_in_ball(int count, std::uint32_t seed) {
  const double width = std::cbrt(count / kFilled);
  const Random random(seed, kStream);
  std::vector<Vec3d> out;
  for (std::uint64_t k = 0; static_cast<int>(out.size()) < count; k += 2) {
    const RandomPair one = random.uniform(CellId{}, k), two = random.uniform(CellId{}, k + 1);
    const Vec3d p{2.0 * one.first - 1.0, 2.0 * one.second - 1.0, 2.0 * two.first - 1.0};
    if (norm2(p) < 1.0) out.push_back(p * width);
  }
  return out;
}

/// Pushes apart all that are nearer than they may be, one pair after the other; the deepest overlap that was found.
double push_apart(std::vector<Vec3d>& places) {
  double deepest = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3d apart = places[i] - places[j];
      const double distance = norm(apart);
      if (!(distance < kTouch) || !(distance > 0.0)) continue;
      deepest = std::max(deepest, kTouch - distance);
      const Vec3d push = apart * (0.5 * (kTouch - distance) / distance);
      places[i] += push, places[j] += push * -1.0;
    }
  return deepest;
}

}  // namespace

std::vector<Vec3d> ball_of_cells(int count, double radius, std::uint32_t seed) {
  std::vector<Vec3d> places = places_in_ball(count, seed);
  for (int round = 0; round < kRounds; ++round) {
    for (Vec3d& p : places) p = p * (1.0 - kDraw * (1.0 - static_cast<double>(round) / kRounds));
    for (int sweep = 0; sweep < kSweeps && push_apart(places) > kClear; ++sweep) {
    }
  }
  for (int sweep = 0; sweep < kLastSweeps && push_apart(places) > kClear; ++sweep) {
  }
  Vec3d mean{};
  for (const Vec3d& p : places) mean += p * (1.0 / count);
  const auto rounded = [&](double x) { return std::round(x / kRounded) * kRounded * radius; };
  for (Vec3d& p : places) p = {rounded(p.x - mean.x), rounded(p.y - mean.y), rounded(p.z - mean.z)};
  return places;
}

}  // namespace morula::scenarios
