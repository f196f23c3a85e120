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

/// Where a cell with these weights sees a linear field.
Vec3d place_of(const Grid& grid, const std::vector<VoxelWeight>& weights) {
  Vec3d mean{};
  for (const auto& w : weights) {
    const auto n = grid.extent(w.brick);
    const auto p = grid.place(w.brick);
    mean +=
        grid.voxel_center({8 * p[0] + w.voxel % n[0], 8 * p[1] + (w.voxel / n[0]) % n[1], 8 * p[2] + w.voxel / (n[0] * n[1])}) * w.weight;
  }
  return mean;
}

TEST(CellWeights, AddUpToOneAndSeeTheCellWhereItIs) {
  const Space space = cube(100.0);
  const Grid grid = grid_for(spec_of(1.0, 10.0), space).value();
  std::vector<VoxelWeight> weights;
  for (int k = 0; k < 40; ++k) {
    const Vec3d center{43.1 + 0.37 * k, 52.7 - 0.29 * k, 38.9 + 0.53 * k};
    for (const double radius : {1.0, 4.9, 5.5, 6.0, 8.0, 10.0, 17.0}) {
      sphere_weights(grid, space, center, radius, weights);
      double sum = 0.0;
      for (const auto& w : weights) {
        EXPECT_GE(w.weight, 0.0);
        sum += w.weight;
      }
      EXPECT_DOUBLE_EQ(sum, 1.0);
      // Trilinear weights are centred exactly. Shares of the volume are off by h/π |3 (sin x − x cos x)/x³|, x = 2πR/h, along each axis: 0.24 at R = h, and the lines add 0.05.
      const Vec3d off = place_of(grid, weights) - center;
      for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_LT(std::abs(off[axis]), radius < 5.0 ? 1e-12 : 0.3) << radius;
    }
  }
}

/// A sphere that grows in a field that does not change sees nothing new all at once.
TEST(CellWeights, NothingJumpsWhereASphereGrows) {
  const Space space = cube(100.0);
  const Grid grid = grid_for(spec_of(1.0, 10.0), space).value();
  std::vector<VoxelWeight> weights;
  for (const Vec3d& center : {Vec3d{43.1, 52.7, 38.9}, Vec3d{42.5, 47.5, 52.5}, Vec3d{41.0, 59.0, 45.0}}) {
    Vec3d before = center;
    for (double radius = 4.8; radius < 12.0; radius += 0.02) {
      sphere_weights(grid, space, center, radius, weights);
      EXPECT_LT(norm(place_of(grid, weights) - before), 0.1) << radius;  // where the number of lines changes
      before = place_of(grid, weights);
    }
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
  EXPECT_NEAR(beyond, 0.15625, 0.002);
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
