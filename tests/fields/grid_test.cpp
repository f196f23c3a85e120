#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "fields/cell_weights.h"
#include "tests/fields/helpers.h"

namespace morula::fields::test {
namespace {

TEST(Grid, VoxelsDivideTheDomainAndAreNotLargerThanWanted) {
  Space space;
  space.box = {{-10, 0, 5}, {90, 64, 13}};
  const Grid grid = grid_for(spec_of(1.0, 8.0), space).value();
  EXPECT_EQ(grid.voxels, (std::array<std::int32_t, 3>{13, 8, 1}));
  EXPECT_EQ(grid.bricks, (std::array<std::int32_t, 3>{2, 1, 1}));
  EXPECT_EQ(grid.extent(0), (std::array<std::int32_t, 3>{8, 8, 1}));
  EXPECT_EQ(grid.extent(1), (std::array<std::int32_t, 3>{5, 8, 1}));
  EXPECT_DOUBLE_EQ(grid.spacing().x, 100.0 / 13);
  EXPECT_NEAR(grid.voxel_volume() * static_cast<double>(grid.voxel_count()), 100.0 * 64 * 8, 1e-9);
}

TEST(Grid, RejectsAVoxelSizeThatIsNotPositive) {
  for (const double voxel : {0.0, -1.0, std::nan(""), 1e-300}) EXPECT_FALSE(grid_for(spec_of(1.0, voxel), cube(100.0)).ok());
}

TEST(Grid, OwnersAreEvenAndLeaveNoRankWithoutBricks) {
  const Grid grid = grid_for(spec_of(1.0, 1.0), cube(30.0)).value();
  const auto owner = owners_along_curve(grid, 5);
  std::array<int, 5> count{};
  for (const int r : owner) ++count[static_cast<std::size_t>(r)];
  for (const int n : count) EXPECT_NEAR(n, 64.0 / 5, 1.0);
}

TEST(CellWeights, AddUpToOneAndAreCentredOnTheCell) {
  const Space space = cube(100.0);
  const Grid grid = grid_for(spec_of(1.0, 10.0), space).value();
  std::vector<VoxelWeight> weights;
  for (const double radius : {1.0, 4.9, 6.0, 17.0}) {
    const Vec3d center{43.1, 52.7, 38.9};
    sphere_weights(grid, space, center, radius, weights);
    double sum = 0.0;
    Vec3d mean{};
    for (const auto& w : weights) {
      const auto n = grid.extent(w.brick);
      const auto p = grid.place(w.brick);
      EXPECT_GE(w.weight, 0.0);
      sum += w.weight;
      mean +=
          grid.voxel_center({8 * p[0] + w.voxel % n[0], 8 * p[1] + (w.voxel / n[0]) % n[1], 8 * p[2] + w.voxel / (n[0] * n[1])}) * w.weight;
    }
    EXPECT_EQ(sum, 1.0);
    // Trilinear weights are centred exactly; volume shares only when the sphere covers many voxels.
    EXPECT_LT(norm(mean - center), radius < 5.0 ? 1e-12 : 3.0) << radius;
  }
}

TEST(CellWeights, MatchTheVolumeOfASphereInTheVoxels) {
  // A sphere of R = 10 in the corner of eight voxels of 10 µm: one eighth each.
  const Space space = cube(80.0);
  const Grid grid = grid_for(spec_of(1.0, 10.0), space).value();
  std::vector<VoxelWeight> weights;
  sphere_weights(grid, space, {40, 40, 40}, 10.0, weights);
  ASSERT_EQ(weights.size(), 8u);
  for (const auto& w : weights) EXPECT_DOUBLE_EQ(w.weight, 0.125);
  // Centred in a voxel: the cap beyond a plane at 5 µm has π(R−5)²(2R+5)/3 = 25π·25/3 of 4πR³/3, or 15.625 %, less the edges.
  sphere_weights(grid, space, {45, 45, 45}, 10.0, weights);
  double beyond = 0.0;
  for (const auto& w : weights)
    if (w.voxel % 8 == 5) beyond += w.weight;
  EXPECT_NEAR(beyond, 0.15625, 0.02);
}

TEST(CellWeights, StayInsideTheDomainAndWrapAroundPeriodicFaces) {
  const Space walls = cube(80.0), periodic = cube(80.0, BoundaryKind::kPeriodic);
  const Grid grid = grid_for(spec_of(1.0, 10.0), walls).value();
  std::vector<VoxelWeight> weights;
  const auto planes = [&] {
    std::set<int> x;
    double sum = 0.0;
    for (const auto& w : weights) {
      x.insert(w.voxel % 8);
      sum += w.weight;
    }
    EXPECT_EQ(sum, 1.0);
    return x;
  };
  sphere_weights(grid, walls, {0.0, 45, 45}, 6.0, weights);
  EXPECT_EQ(planes(), (std::set<int>{0}));
  sphere_weights(grid, periodic, {0.0, 45, 45}, 6.0, weights);
  EXPECT_EQ(planes(), (std::set<int>{0, 7}));
  sphere_weights(grid, walls, {500.0, 45, 45}, 6.0, weights);
  EXPECT_EQ(planes(), (std::set<int>{7}));
  sphere_weights(grid, periodic, {40, 40, 40}, 300.0, weights);
  EXPECT_EQ(weights.size(), 512u) << "a voxel that is met by several images is listed once";
}

}  // namespace
}  // namespace morula::fields::test
