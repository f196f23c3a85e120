#include "scenarios/measures/shape_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "study/initial/biconcave.h"

namespace morula::scenarios {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A shell whose nodes are those of an icosphere moved by a function of their direction.
struct Body {
  std::shared_ptr<const ReferenceShape> shape;
  std::vector<Vec3d> nodes;
  Snapshot::Cell cell;

  template <class F>
  Body(std::uint32_t count, F&& place) {
    ShapeLibrary shapes;
    shape = shapes.icosphere(count).value();
    for (const Vec3d& p : shape->position) nodes.push_back(place(normalized(p)));
    cell.centroid = volume_centroid(shape->topology->faces(), nodes);
    cell.volume = enclosed_volume(shape->topology->faces(), nodes, cell.centroid);
  }
  [[nodiscard]] ShellView view() const { return {nodes, shape->topology->faces(), &cell}; }
};

/// A sphere of radius r, what lies below the plane z = 0 laid onto it.
Body cap(std::uint32_t count, double radius, double angle) {
  return {count, [=](const Vec3d& n) {
            Vec3d x = n * radius + Vec3d{0, 0, radius * std::cos(angle)};
            x.z = std::max(x.z, 0.0);
            return x + Vec3d{5, -3, 2};
          }};
}

TEST(NodeToVolumeRadius, IsThatOfThePublishedMeshes) {  // time_stepping.md §9: 0.9886 and 0.9971
  EXPECT_NEAR(node_to_volume_radius(162), 0.9886, 5e-5);
  EXPECT_NEAR(node_to_volume_radius(642), 0.9971, 5e-5);
  EXPECT_EQ(node_to_volume_radius(100), 1.0);
}

TEST(CapFit, FindsTheSphereThatACapIsPartOf) {
  for (const double degrees : {20.0, 60.0, 90.0, 110.0}) {
    const Body body = cap(642, 7.0, degrees * kDegree);
    const auto fit = fit_cap(body.view(), {0, 0, 2}, {0, 0, 1});
    ASSERT_TRUE(fit.has_value());
    const double factor = node_to_volume_radius(642);
    EXPECT_NEAR(fit->radius, 7.0 * factor, 1e-9);
    EXPECT_NEAR(fit->angle / kDegree, std::acos(std::cos(degrees * kDegree) / factor) / kDegree, 1e-6) << degrees;
    EXPECT_NEAR(fit->height, 7.0 * (factor + std::cos(degrees * kDegree)), 1e-9);
    EXPECT_NEAR(fit->contact_radius, 7.0 * std::sin(degrees * kDegree), 0.02 * 7.0);
  }
}

TEST(CurvatureAlong, IsThatOfAParaboloidHoweverTiltedAndOfASphere) {
  const Body dent(642, [](const Vec3d& n) {
    const Vec3d x = n * 7.0;
    return x.z > 0.0 ? Vec3d{x.x, x.y, 3.0 + 0.1 * x.x + (x.x * x.x + x.y * x.y) / 24.0} : x;
  });
  const auto inwards = curvature_along(dent.view(), {0, 0, 1}, 3.0);
  ASSERT_TRUE(inwards.has_value());
  EXPECT_NEAR(*inwards, -1.0 / 12.0, 1e-9);
  const Body ball(642, [](const Vec3d& n) { return n * 7.0; });
  const auto outwards = curvature_along(ball.view(), normalized(Vec3d{1, 2, -1}), 2.0);
  ASSERT_TRUE(outwards.has_value());
  EXPECT_NEAR(*outwards * 7.0, 1.0, 0.05);  // r⁴/(8 R³), which a paraboloid has not, is 2 % of r²/(2 R) at the rim
  EXPECT_FALSE(curvature_along(ball.view(), {0, 0, 1}, 0.1).has_value());
}

TEST(CapFit, DoesNotDependOnWhereThePlaneIs) {
  const Body body = cap(162, 6.0, 1.0);
  std::vector<Vec3d> turned;
  for (const Vec3d& x : body.nodes) turned.push_back({x.z + 1000.0, x.x, x.y});
  const auto upright = fit_cap(body.view(), {0, 0, 2}, {0, 0, 1});
  const auto sideways = fit_cap({turned, body.shape->topology->faces(), &body.cell}, {1002, 0, 0}, {1, 0, 0});
  ASSERT_TRUE(upright && sideways);
  EXPECT_NEAR(upright->angle, sideways->angle, 1e-9);
  EXPECT_NEAR(upright->contact_radius, sideways->contact_radius, 1e-9);
}

TEST(CapFit, RefusesAPlane) {
  const Body flat(162, [](const Vec3d& n) { return Vec3d{n.x, n.y, 1.0}; });
  EXPECT_FALSE(fit_cap(flat.view(), {0, 0, 0}, {0, 0, 1}).has_value());
}

TEST(SecondMode, OfAKnownDisplacementIsFoundExactly) {
  const Vec3d axis = normalized(Vec3d{1, 1, 0});
  const Body before(642, [](const Vec3d& n) { return n * 6.0; });
  const Body after(642, [&](const Vec3d& n) {
    const double c = dot(n, axis);
    return n * (6.0 + 0.02 + 0.09 * (1.5 * c * c - 0.5)) + Vec3d{4, 5, 6};
  });
  const SecondMode mode = fit_second_mode(before.view(), after.view(), axis);
  EXPECT_NEAR(mode.axial, 0.11 / 6.0, 1e-6);
  EXPECT_NEAR(mode.transverse, (0.02 - 0.045) / 6.0, 1e-6);
  EXPECT_LT(mode.residual, 1e-6);
}

TEST(SecondMode, LeavesAnotherModeOver) {
  const Body before(642, [](const Vec3d& n) { return n * 6.0; });
  const Body after(642, [](const Vec3d& n) { return n * (6.0 + 0.06 * (35 * std::pow(n.x, 4) - 30 * n.x * n.x + 3) / 8.0); });
  const SecondMode mode = fit_second_mode(before.view(), after.view(), {1, 0, 0});
  EXPECT_NEAR(mode.axial, 0.0, 1e-4);
  EXPECT_NEAR(mode.residual, 0.01 / 3.0, 1e-4);  // ⟨P4²⟩ = 1/9
}

TEST(Extent, IsMeasuredAlongTheAxis) {
  const std::vector<Vec3d> nodes{{0, 0, 0}, {3, 1, 0}, {-2, 5, 1}};
  EXPECT_DOUBLE_EQ(extent(nodes, {1, 0, 0}), 5.0);
  EXPECT_DOUBLE_EQ(extent(nodes, {0, 0, 1}), 1.0);
}

TEST(Biconcave,
     IsTheRestingRedBloodCell) {  // Evans & Fung 1972, R = 3.91 µm: 94.1 µm³, 134.1 µm², 0.81 µm in the middle, 2.57 µm at the rim
  ShapeLibrary shapes;
  const auto sphere = shapes.icosphere(2562).value();
  const auto shape = biconcave_shape(*sphere);
  ASSERT_NE(shape, nullptr);
  double widest = 0.0, thickest = 0.0, middle = 1e300, area = 0.0;
  for (const Vec3d& p : shape->position) widest = std::max(widest, std::hypot(p.x, p.y));
  const double scale = 3.91 / widest;
  for (const Vec3d& p : shape->position) {
    thickest = std::max(thickest, 2.0 * scale * p.z);
    if (p.z > 0.0 && std::hypot(p.x, p.y) < 0.05 * widest) middle = std::min(middle, 2.0 * scale * p.z);
  }
  for (const double a : shape->face_area) area += a * scale * scale;
  EXPECT_NEAR(scale * scale * scale, 94.1, 0.5);  // the reference shape encloses 1
  EXPECT_NEAR(area, 134.1, 0.5);
  EXPECT_NEAR(thickest, 2.57, 0.02);
  EXPECT_NEAR(middle, 0.81, 0.02);
}

}  // namespace
}  // namespace morula::scenarios
