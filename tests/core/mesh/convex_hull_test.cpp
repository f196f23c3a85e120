#include "core/mesh/convex_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/mesh/icosphere.h"
#include "core/random/philox.h"

namespace morula {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<Vec3d> corners_of_a_box(const Vec3d& size) {
  std::vector<Vec3d> points;
  for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? size.x : 0.0, i & 2 ? size.y : 0.0, i & 4 ? size.z : 0.0});
  return points;
}

TEST(ConvexHull, OfABoxHasTheMeasuresOfABox) {
  auto points = corners_of_a_box({2, 3, 5});
  points.push_back({1, 1, 1});    // inside
  points.push_back({1, 1.5, 5});  // on a face
  points.push_back({0, 0, 2.5});  // on an edge
  points.push_back({2, 3, 5});    // a corner again
  const auto hull = convex_hull(points);
  ASSERT_TRUE(hull.ok());
  EXPECT_EQ(hull->faces.size(), 12u);
  EXPECT_NEAR(hull->volume, 30.0, 1e-12);
  EXPECT_NEAR(hull->area, 62.0, 1e-12);
  EXPECT_NEAR(hull->mean_curvature, kPi * (2 + 3 + 5), 1e-12);  // ½ · 12 edges (4 of each length) · π/2
}

TEST(ConvexHull, InflatedByAMarginAddsSlabsQuarterCylindersAndABall) {
  const auto hull = convex_hull(corners_of_a_box({2, 3, 5}));
  ASSERT_TRUE(hull.ok());
  const double r = 0.7;
  EXPECT_NEAR(hull->inflated_volume(r), 30.0 + 62.0 * r + kPi * 10.0 * r * r + 4.0 / 3.0 * kPi * r * r * r, 1e-12);
  EXPECT_DOUBLE_EQ(hull->inflated_volume(0.0), hull->volume);
}

TEST(ConvexHull, OfARegularTetrahedron) {
  const auto hull = convex_hull({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});
  ASSERT_TRUE(hull.ok());
  EXPECT_EQ(hull->faces.size(), 4u);
  const double edge = std::sqrt(8.0);
  EXPECT_NEAR(hull->volume, edge * edge * edge / (6.0 * std::numbers::sqrt2), 1e-12);
  EXPECT_NEAR(hull->area, std::numbers::sqrt3 * edge * edge, 1e-12);
  EXPECT_NEAR(hull->mean_curvature, 0.5 * 6.0 * edge * (kPi - std::acos(1.0 / 3.0)), 1e-12);
}

TEST(ConvexHull, OfAnIcosphereIsTheIcosphere) {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(162).value();
  std::vector<Vec3d> points(shape->position.begin(), shape->position.end());
  for (std::uint64_t i = 0; i < 200; ++i)  // inside
    points.push_back(Random(3, RandomStream::kInitialPosition).direction(CellId::founder(i + 1), 0) *
                     (0.55 * static_cast<double>(i) / 200.0));
  const auto hull = convex_hull(points);
  ASSERT_TRUE(hull.ok());
  EXPECT_EQ(hull->faces.size(), 320u);
  for (const Triangle& t : hull->faces)
    for (const auto i : t) EXPECT_LT(i, 162u);
  for (const Vec3d& p : points) EXPECT_GE(hull->depth(p), -1e-9);
}

TEST(ConvexHull, DepthIsPositiveInsideAndNegativeOutside) {
  const auto hull = convex_hull(corners_of_a_box({2, 4, 6}));
  ASSERT_TRUE(hull.ok());
  EXPECT_NEAR(hull->depth({0.25, 2, 3}), 0.25, 1e-14);
  EXPECT_NEAR(hull->depth({1, 2, 3}), 1.0, 1e-14);
  EXPECT_NEAR(hull->depth({-0.5, 2, 3}), -0.5, 1e-14);
}

TEST(ConvexHull, RefusesPointsThatSpanNoVolume) {
  EXPECT_FALSE(convex_hull({}).ok());
  EXPECT_FALSE(convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).ok());
  EXPECT_FALSE(convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.2, 0}}).ok());
  EXPECT_FALSE(convex_hull(std::vector<Vec3d>(10, Vec3d{1, 2, 3})).ok());
}

}  // namespace
}  // namespace morula
