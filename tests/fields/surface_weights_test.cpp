// How cells that are surfaces are spread over the voxels.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/mesh/primitives.h"
#include "core/mesh/surface_geometry.h"
#include "fields/cell_weights.h"
#include "tests/fields/helpers.h"

namespace morula::fields {
namespace {

using test::cube;
using test::field_of;
using test::spec_of;

Grid grid_of(double voxel, const Space& space) { return grid_for(spec_of(1.0, voxel), space).value(); }

double weight_at(const Grid& grid, const std::vector<VoxelWeight>& weights, int x, int y, int z) {
  const std::int64_t brick = grid.brick_at({x / 8, y / 8, z / 8});
  const auto n = grid.extent(brick);
  for (const VoxelWeight& w : weights)
    if (w.brick == brick && w.voxel == (x % 8) + n[0] * ((y % 8) + n[1] * (z % 8))) return w.weight;
  return 0.0;
}

double sum_of(const std::vector<VoxelWeight>& weights) {
  double sum = 0.0;
  for (const VoxelWeight& w : weights) sum += w.weight;
  return sum;
}

TriangleMesh moved(TriangleMesh mesh, const Vec3d& by) {
  for (Vec3d& x : mesh.position) x += by;
  return mesh;
}

std::vector<VoxelWeight> weights_of(const Grid& grid, const Space& space, const TriangleMesh& mesh, const Vec3d& center) {
  std::vector<VoxelWeight> out;
  surface_weights(grid, space, center, mesh.faces, mesh.position, out);
  return out;
}

/// A box that covers voxels by known parts: along x from 24 to 60 in voxels of 10, along y from 30 to 40, along z from 15 to 50.
TEST(SurfaceWeights, OfABoxAreItsPartsInTheVoxels) {
  const Space space = cube(80.0);
  const Grid grid = grid_of(10.0, space);
  const Vec3d center{42.0, 35.0, 32.5};
  const auto weights = weights_of(grid, space, moved(make_box({36.0, 10.0, 35.0}, 100.0).value(), center), center);
  const double x[7] = {0.0, 0.0, 6.0 / 36.0, 10.0 / 36.0, 10.0 / 36.0, 10.0 / 36.0, 0.0};
  const double z[6] = {0.0, 5.0 / 35.0, 10.0 / 35.0, 10.0 / 35.0, 10.0 / 35.0, 0.0};
  // Lines stand at the middles of strips of 10/12: a face of the box misses at most half a strip.
  for (int i = 0; i < 7; ++i)
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(weight_at(grid, weights, i, 3, k), x[i] * z[k], 0.5 * 10.0 / 12.0 / 36.0) << i << k;
  EXPECT_EQ(weight_at(grid, weights, 3, 2, 2) + weight_at(grid, weights, 3, 4, 2), 0.0);
  EXPECT_EQ(sum_of(weights), 1.0);
}

/// The volume of a ball of radius 1 below the height h is π(1 + h)²(2 − h)/3.
TEST(SurfaceWeights, OfAnIcosphereAreThoseOfTheBall) {
  const Space space = cube(64.0);
  const double radius = 6.0;
  const Vec3d center{33.1, 31.4, 30.3};
  for (const double voxel : {2.0, 4.0}) {
    const Grid grid = grid_of(voxel, space);
    const auto weights = weights_of(grid, space, moved(make_sphere(radius, 4).value(), center), center);
    const int n = static_cast<int>(64.0 / voxel);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double below = 0.0;
      for (int layer = 0; layer < n; ++layer) {
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j) {
            int at[3] = {i, i, i};
            at[axis] = layer, at[(axis + 1) % 3] = i, at[(axis + 2) % 3] = j;
            below += weight_at(grid, weights, at[0], at[1], at[2]);
          }
        const double h = std::clamp(((layer + 1) * voxel - center[axis]) / radius, -1.0, 1.0);
        ASSERT_NEAR(below, (1 + h) * (1 + h) * (2 - h) / 4.0, 0.01) << "voxel " << voxel << ", axis " << axis << ", layer " << layer;
      }
    }
    EXPECT_EQ(sum_of(weights), 1.0);
  }
}

/// The same cell as a sphere and as a shell sees the same and takes it from the same voxels, whatever the size of these.
TEST(SurfaceWeights, AreThoseOfTheSphere) {
  const Space space = cube(80.0);
  const Grid grid = grid_of(10.0, space);
  std::vector<VoxelWeight> of_sphere;
  for (const double radius : {3.0, 4.9, 5.1, 6.0, 8.0, 11.0})
    for (int k = 0; k < 10; ++k) {
      const Vec3d center{33.1 + 1.1 * k, 41.4 - 0.7 * k, 36.3 + 0.9 * k};
      TriangleMesh mesh = make_sphere(radius, 2).value();
      double volume = 0.0;
      for (const Triangle& t : mesh.faces) volume += dot(mesh.position[t[0]], cross(mesh.position[t[1]], mesh.position[t[2]])) / 6.0;
      const double scale = radius / std::cbrt(3.0 * volume / (4.0 * std::numbers::pi));
      for (Vec3d& x : mesh.position) x = x * scale + center;
      sphere_weights(grid, space, center, radius, of_sphere);
      const auto of_shell = weights_of(grid, space, mesh, center);
      double differ = 0.0;
      for (int x = 0; x < 8; ++x)
        for (int y = 0; y < 8; ++y)
          for (int z = 0; z < 8; ++z) differ += 0.5 * std::abs(weight_at(grid, of_shell, x, y, z) - weight_at(grid, of_sphere, x, y, z));
      EXPECT_LT(differ, radius < 5.0 ? 1e-12 : 0.01) << radius << " " << k;
    }
}

/// A flat disc lies in one layer of voxels, where the ball of its volume would reach into three.
TEST(SurfaceWeights, FollowTheShape) {
  const Space space = cube(64.0);
  const Grid grid = grid_of(4.0, space);
  const Vec3d center{32.0, 32.0, 30.0};
  const auto weights = weights_of(grid, space, moved(make_cylinder(10.0, 2.0, 1.0).value(), center), center);
  double in_layer = 0.0;
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 16; ++j) in_layer += weight_at(grid, weights, i, j, 7);
  EXPECT_NEAR(in_layer, 1.0, 1e-12);
  EXPECT_NEAR(weight_at(grid, weights, 7, 7, 7), 16.0 / (std::numbers::pi * 100.0), 0.002);
}

TEST(SurfaceWeights, GoAroundAPeriodicDomainAndStayInAClosedOne) {
  const TriangleMesh ball = make_sphere(6.0, 2).value();
  const Vec3d corner{0.5, 31.0, 63.0};
  for (const BoundaryKind kind : {BoundaryKind::kPeriodic, BoundaryKind::kWall}) {
    const Space space = cube(64.0, kind);
    const Grid grid = grid_of(8.0, space);
    const auto weights = weights_of(grid, space, moved(ball, corner), corner);
    EXPECT_EQ(sum_of(weights), 1.0);
    const double beyond = weight_at(grid, weights, 7, 3, 7) + weight_at(grid, weights, 7, 3, 0);
    if (kind == BoundaryKind::kPeriodic)
      EXPECT_GT(beyond, 0.2);
    else
      EXPECT_EQ(beyond, 0.0);
  }
  const Space space = cube(64.0);
  const Vec3d outside{-20.0, 31.0, 90.0};
  const auto weights = weights_of(grid_of(8.0, space), space, moved(ball, outside), outside);
  ASSERT_EQ(weights.size(), 1u);
  EXPECT_EQ(weight_at(grid_of(8.0, space), weights, 0, 3, 7), 1.0) << "the nearest voxel";
}

/// As CellsGetWhatTheFieldLoses of spheres: surfaces of 162 nodes, some across the faces of the domain and some alike balls among them.
TEST(SurfaceWeights, CellsGetWhatTheFieldLoses) {
  const Space space = cube(160.0);
  FieldSpec spec = spec_of(2000.0, 10.0, 0.2);
  spec.reactions = {test::uptake_of(40.0, 0.005)};
  std::vector<TriangleMesh> meshes;
  for (int i = 0; i < 20; ++i) meshes.push_back(moved(make_sphere(6.0, 2).value(), {8.0 * i, 160.0 - 7.7 * i, 40.0 + 3.1 * i}));
  std::vector<CellSource> cells;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const auto k = static_cast<double>(i);
    CellSource& cell = cells.emplace_back(CellSource{CellId::founder(i + 1), 0, {8.0 * k, 160.0 - 7.7 * k, 40.0 + 3.1 * k}, 6.0});
    if (i % 3 != 0) cell.faces = meshes[i].faces, cell.nodes = meshes[i].position;
  }
  Field field = field_of(spec, space);
  const double start = total_amount(field, test::alone());
  std::vector<double> taken(cells.size(), 0.0);
  for (int i = 0; i < 50; ++i) EXPECT_LT(test::advance(field, spec, space, 0.5, cells, &taken).balance_error(), 1e-13);
  double sum = 0.0;
  for (const double amount : taken) sum += amount;
  EXPECT_NEAR(sum, 20 * 40.0 * 25.0, 0.06 * sum);  // nearly saturated
  EXPECT_NEAR((total_amount(field, test::alone()) + sum) / start, 1.0, 1e-12);
}

/// Lines through nodes and along edges: a surface whose nodes lie on the sample lines is still closed for all of them.
TEST(SurfaceWeights, LoseNothingWhereLinesMeetNodesAndEdges) {
  const Space space = cube(64.0);
  const Grid grid = grid_of(8.0, space);
  const Vec3d center{32.5, 32.5, 32.0};  // lines stand 1 µm apart, at 26.5, 27.5, ...
  const auto weights = weights_of(grid, space, moved(make_box({12.0, 12.0, 12.0}, 2.0).value(), center), center);
  double inside = 0.0;
  for (int i = 3; i < 5; ++i)
    for (int j = 3; j < 5; ++j)
      for (int k = 3; k < 5; ++k) inside += weight_at(grid, weights, i, j, k);
  EXPECT_NEAR(inside, 1.0, 1e-12);
  EXPECT_NEAR(weight_at(grid, weights, 3, 3, 3) / weight_at(grid, weights, 3, 3, 4), 1.0, 1e-12);
}

}  // namespace
}  // namespace morula::fields
