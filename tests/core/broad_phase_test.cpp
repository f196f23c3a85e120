/// Pairs of bodies are those that a look at each against each finds, for all and for some, in open space and where it repeats.
#include "core/contact/broad_phase.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <tuple>
#include <vector>

namespace morula {
namespace {

struct Bodies {
  std::vector<Extent> extents;
  std::vector<std::uint32_t> place;
};

/// Balls of 1 to 2 in a box of 20; the order of their places is any.
Bodies random_balls(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-10.0, 10.0), size(1.0, 2.0);
  Bodies out;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d center{at(random), at(random), at(random)};
    const double radius = size(random);
    out.extents.push_back({Box{center, center}.inflated(radius), center, radius});
  }
  out.place.resize(count);
  std::iota(out.place.begin(), out.place.end(), 0u);
  std::shuffle(out.place.begin(), out.place.end(), random);
  return out;
}

using Found = std::vector<std::tuple<std::uint32_t, std::uint32_t, Vec3d>>;

Found each_against_each(const Bodies& bodies, const std::vector<char>& counts, const Space& space) {
  std::vector<std::uint32_t> by_place(bodies.place.size());
  for (std::uint32_t i = 0; i < by_place.size(); ++i) by_place[bodies.place[i]] = i;
  Found out;
  for (std::size_t p = 0; p < by_place.size(); ++p)
    for (std::size_t q = p + 1; q < by_place.size(); ++q) {
      const std::uint32_t a = by_place[p], b = by_place[q];
      if (!counts[a] && !counts[b]) continue;
      const Vec3d direct = bodies.extents[b].center - bodies.extents[a].center, nearest = space.nearest_image(direct);
      if (norm(nearest) < bodies.extents[a].radius + bodies.extents[b].radius) out.emplace_back(a, b, nearest - direct);
    }
  return out;
}

void expect_same(const Found& found, const Found& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(std::get<0>(found[k]), std::get<0>(wanted[k]));
    EXPECT_EQ(std::get<1>(found[k]), std::get<1>(wanted[k]));
    EXPECT_LT(norm(std::get<2>(found[k]) - std::get<2>(wanted[k])), 1e-12);
  }
}

class BroadPhase : public testing::TestWithParam<std::tuple<bool, int>> {};

TEST_P(BroadPhase, FindsThePairsOfAllAndOfSome) {
  const auto [periodic, threads] = GetParam();
  Space space;
  space.box = {{-10, -10, -10}, {10, 10, 10}};
  if (periodic)
    for (auto& axis : space.boundary) axis = {BoundaryKind::kPeriodic, BoundaryKind::kPeriodic};
  const Bodies bodies = random_balls(800);
  Found found;
  const auto take = [&](const BodyPair& pair) { found.emplace_back(pair.a, pair.b, pair.shift); };
  std::vector<char> counts(bodies.extents.size(), 1);
  find_body_pairs(bodies.extents, bodies.place, counts, space, threads, take);
  const Found all = each_against_each(bodies, counts, space);
  EXPECT_GT(all.size(), 2000u);
  expect_same(found, all);

  std::vector<std::uint32_t> some;
  std::fill(counts.begin(), counts.end(), 0);
  for (std::uint32_t i = 3; i < counts.size(); i += 17) some.push_back(i), counts[i] = 1;
  found.clear();
  find_body_pairs_of(some, bodies.extents, bodies.place, space, threads, take);
  const Found of_some = each_against_each(bodies, counts, space);
  EXPECT_GT(of_some.size(), 200u);
  expect_same(found, of_some);
}

INSTANTIATE_TEST_SUITE_P(OpenAndPeriodic, BroadPhase, testing::Combine(testing::Bool(), testing::Values(1, 3)));

}  // namespace
}  // namespace morula
