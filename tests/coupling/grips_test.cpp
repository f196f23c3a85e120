#include "coupling/loads/grips.h"

#include <gtest/gtest.h>

#include <cmath>

#include "coupling/loads/loads.h"
#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

CellLoad grip(double stiffness, const Vec3d& center) {
  CellLoad load;
  load.name = "grip";
  load.what = grip_load();
  load.size = stiffness;
  load.axis = {0, 0, 1};
  load.end = LoadEnd::kHigh;
  load.part = 0.1;
  load.center = center;
  return load;
}

std::unique_ptr<Simulation> simulation(const Model& model) {
  ShapeLibrary shapes;
  return std::move(Simulation::create(model, test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}), Comm(), 1)).value();
}

TEST(Grip, PullsNothingWhileTheCellIsWhereItHoldsIt) {
  Model model = test::clusters_model();
  model.loads = {grip(10.0, {0, 0, 0})};
  auto s = simulation(model);
  EXPECT_LT(norm(grip_forces(model, s->tissue(), Comm())[0]), 1e-10);
  const auto anchors = grip_anchors(model, s->tissue(), 0.0);
  EXPECT_GE(anchors.size(), 16u);  // a tenth of 162, ties taken in
  double stiffness = 0.0;
  for (const Anchor& anchor : anchors) stiffness += anchor.stiffness;
  EXPECT_NEAR(stiffness, 10.0, 1e-12);
}

CellLoad trap(double stiffness, const Vec3d& center) {
  CellLoad load = grip(stiffness, center);
  load.what = trap_load();
  return load;
}

/// At rest a trap bears the whole load of a cell of either body, whose centre gave way by F/K; the surface of a shell stays as it would be without.
TEST(Trap, BearsTheLoadThatActsOnItsCell) {
  for (const BodyKind body : {BodyKind::kShell, BodyKind::kSphere}) {
    Model model = test::clusters_model();
    model.step.newton_stop = 1e-3;
    model.step.first_tolerance = 1e-4;
    model.step.max_newton = 8;
    CellLoad push;
    push.force = {0.3, 0, -0.4};
    model.loads = {trap(10.0, {1, 0, 0}), push};
    ShapeLibrary shapes;
    auto s = std::move(Simulation::create(model, test::make_tissue(model, shapes, {{1, 0, 0}}, {body}), Comm(), 1)).value();
    while (s->tissue().clock.time < 300.0) ASSERT_TRUE(s->step(300.0).ok());
    const Vec3d force = grip_forces(model, s->tissue(), Comm())[0];
    EXPECT_NEAR(force.x, -0.3, 1e-3);
    EXPECT_NEAR(force.z, 0.4, 1e-3);
    const Vec3d at = held_place(grip_anchors(model, s->tissue(), 0.0).at(0), s->tissue());
    EXPECT_LT(norm(at - s->centers()[0]), 1e-12);
    EXPECT_NEAR(at.x - 1.0, 0.03, 1e-4);
    EXPECT_NEAR(at.z, -0.04, 1e-4);
  }
}

/// At rest the grip bears the whole load, and its nodes have given way by F/K on average.
TEST(Grip, BearsTheLoadThatActsOnItsCell) {
  Model model = test::clusters_model();
  model.step.newton_stop = 1e-3;
  model.step.first_tolerance = 1e-4;
  model.step.max_newton = 8;
  CellLoad push;
  push.force = {0, 0, -0.4};  // along the axis: a cell that is held by a cap tilts slowly under anything else
  model.loads = {grip(10.0, {0, 0, 0}), push};
  auto s = simulation(model);
  while (s->tissue().clock.time < 300.0) ASSERT_TRUE(s->step(300.0).ok());
  const Vec3d force = grip_forces(model, s->tissue(), Comm())[0];
  EXPECT_NEAR(force.x, 0.0, 4e-3);
  EXPECT_NEAR(force.z, 0.4, 4e-3);
  Vec3d way{};
  const auto anchors = grip_anchors(model, s->tissue(), 0.0);
  for (const Anchor& anchor : anchors)
    way += (s->tissue().shells.position[anchor.node] - anchor.target) * (1.0 / static_cast<double>(anchors.size()));
  EXPECT_NEAR(way.z, -0.04, 4e-4);
}

TEST(Grip, TakesTheCellAlongItsWayAndLandsOnItsCorners) {
  Model model = test::clusters_model();
  CellLoad load = grip(100.0, {0, 0, 0});
  load.direction = {1, 0, 0};
  load.way = {{5.0, 25.0}, {0.0, 1.0}};
  model.loads = {load};
  auto s = simulation(model);
  bool corner = false;
  while (s->tissue().clock.time < 600.0) {
    ASSERT_TRUE(s->step(600.0).ok());
    corner = corner || s->tissue().clock.time == 25.0;
  }
  EXPECT_TRUE(corner);
  const Vec3d center = s->centers()[0];
  EXPECT_NEAR(center.x, 1.0, 0.02);
  EXPECT_NEAR(center.z, 0.0, 0.02);
  EXPECT_LT(norm(grip_forces(model, s->tissue(), Comm())[0]), 0.05);  // at rest again
}

TEST(Grip, LetsGoWhenItsCourseSaysSo) {
  Model model = test::clusters_model();
  CellLoad load = grip(10.0, {0, 0, 3});
  load.course = {{0.0, 10.0}, {0.0, 0.0}};
  model.loads = {load};
  auto s = simulation(model);
  EXPECT_TRUE(grip_anchors(model, s->tissue(), 5.0).empty());
}

TEST(Load, PressureWithinACylinderActsOnTheFacesThereOnly) {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(642).value();
  CellLoad load;
  load.what = pressure_load();
  load.size = -0.02;
  load.within = true;
  load.low_end = {0, 0, 4};
  load.high_end = {0, 0, 10};
  load.radius = 3.0;
  std::vector<Vec3d> x, force(642);
  for (const Vec3d& p : shape->position) x.push_back(p * std::cbrt(904.779));
  add_shell_load(load, *shape, x, {}, 1.0, force);
  Vec3d whole{};
  for (std::size_t i = 0; i < x.size(); ++i) {
    whole += force[i];
    if (x[i].z < 3.0 || std::hypot(x[i].x, x[i].y) > 4.0) {
      EXPECT_EQ(norm(force[i]), 0.0) << i;
    }
  }
  // The suction lifts what lies below its opening: p π a², less the faces that the rim cuts.
  EXPECT_NEAR(whole.z / (0.02 * 3.14159265 * 9.0), 1.0, 0.08);
}

}  // namespace
}  // namespace morula
