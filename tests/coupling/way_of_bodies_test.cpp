/// How far a tissue goes in a step, where few of many go (decision 0058).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "coupling/mechanics/contact_setup.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kStep = 1.0;      // [s]
constexpr double kApart = 40.0;    // [µm]: nobody touches
constexpr double kLoneFree = 3.0;  // how many times as far as a body a point may go; a sphere twice as far

struct Bodies {
  int spheres = 0, shells = 0;
};

/// A step of cells that touch nobody, in which the first so many shells, or spheres, are pulled by this force [nN]. A body is allowed to go 0.3 µm.
Result<StepReport, StepFault> pull(const Bodies& bodies, BodyKind pulled, int count, double with) {
  Model model = test::clusters_model();
  model.step.max_displacement = 0.3;
  model.contact.range = 1.0;
  model.types[0].shell.tension = model.types[0].shell.shape_stiffness = 0.0;  // shells are at rest
  ShapeLibrary shapes;
  std::vector<Vec3d> at;
  std::vector<BodyKind> kind;
  for (int i = 0; i < bodies.spheres + bodies.shells; ++i) {
    at.push_back({kApart * (i % 10), kApart * (i / 10 % 10), kApart * (i / 100)});
    kind.push_back(i < bodies.spheres ? BodyKind::kSphere : BodyKind::kShell);
  }
  Tissue tissue = test::make_tissue(model, shapes, at, kind);
  tissue.shells.reference_volume = tissue.shells.rest_volume;
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  std::vector<Vec3d> force(tissue.cells.size());  // by body: shells, then spheres
  std::fill_n(force.begin() + (pulled == BodyKind::kShell ? 0 : static_cast<std::ptrdiff_t>(tissue.shells.size())), count,
              Vec3d{with, 0, 0});
  return mechanics.step(tissue, kStep, mechanics.spread(tissue, force));
}

/// Way over displacement (of a point) of a step in which one sphere is pulled, or one shell, and nobody else goes anywhere.
double counted(const Bodies& bodies, BodyKind pulled) {
  const auto report = pull(bodies, pulled, 1, 2.0);
  EXPECT_TRUE(report.ok()) << report.error().what;
  return report.ok() ? report->way / report->displacement : -1.0;
}

/// One of n counts 1.7 n^(-1/4), no more than whole and no less than a third: nobody goes further than a point may.
double lone_of(int n) { return std::max(1.0 / kLoneFree, std::min(1.0, 1.7 * std::pow(n, -0.25))); }
/// The same of spheres, which go twice as far as the displacement says.
double lone_sphere_of(int n) { return std::max(1.0 / kLoneFree, 2.0 * std::min(1.0, 1.7 * std::pow(n, -0.25))); }

TEST(WayOfBodies, OneOfManySpheresCountsLess) {
  for (const int n : {1, 5, 8, 16, 81, 256, 900}) EXPECT_NEAR(counted({.spheres = n}, BodyKind::kSphere), lone_sphere_of(n), 2e-3) << n;
}

TEST(WayOfBodies, ShellsAreComparedWithShellsAndSpheresWithSpheres) {
  EXPECT_NEAR(counted({.spheres = 300, .shells = 1}, BodyKind::kShell), 1.0, 0.02);
  EXPECT_NEAR(counted({.spheres = 1, .shells = 30}, BodyKind::kSphere), 2.0, 0.04);
  EXPECT_NEAR(counted({.spheres = 1, .shells = 40}, BodyKind::kShell), lone_of(40), 0.02);
}

/// Forces by which one shell goes 0.8 µm, which counts as more than 1.5 times what a body is allowed, also of thirty, and 3 µm, which no point may.
struct Far {
  double some, much;
};

Far far() {
  const auto report = pull({.shells = 1}, BodyKind::kShell, 1, 2.0);
  EXPECT_TRUE(report.ok()) << report.error().what;
  const double force = report.ok() ? 2.0 / report->displacement : 0.0;
  return {0.8 * force, 3.0 * force};
}

/// 1.7 (Σ way²/n)^(1/2) is what a tissue goes where a few jump, and what the next step is found from.
TEST(WayOfBodies, AFewThatJumpDoNotStopOthers) {
  const auto report = pull({.shells = 30}, BodyKind::kShell, 1, far().some);
  ASSERT_TRUE(report.ok()) << report.error().what;
  EXPECT_NEAR(report->displacement, 0.8, 0.02);
  EXPECT_NEAR(report->way, 1.7 * 0.8 / std::sqrt(30.0), 0.01);
}

TEST(WayOfBodies, AStepIsRefusedWhereFewCellsAreAllOrManyGo) {
  const Far force = far();
  for (const auto& [shells, pulled] : {std::pair{1, 1}, std::pair{2, 1}, std::pair{30, 10}, std::pair{30, 30}}) {
    const auto report = pull({.shells = shells}, BodyKind::kShell, pulled, force.some);
    ASSERT_FALSE(report.ok()) << shells << " " << pulled;
    EXPECT_TRUE(report.error().smaller_step_may_help);
  }
}

TEST(WayOfBodies, NobodyGoesFurtherThanGhostsReach) { EXPECT_FALSE(pull({.shells = 100}, BodyKind::kShell, 1, far().much).ok()); }

/// The same of spheres that are all pulled away from the middle, the more the further they are: a ball that swells.
double counted_of_swelling(int side, bool with_obstacle) {
  Model model = test::clusters_model();
  model.step.max_displacement = 0.3;
  model.contact.range = 1.0;
  const double middle = 0.5 * kApart * (side - 1);
  if (with_obstacle) {
    model.obstacles.push_back({.name = "far",
                               .position = {{900, 0, 0}, {910, 0, 0}, {900, 10, 0}, {900, 0, 10}},
                               .faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
    model.pairs.assign(4, model.pairs[0]);
  }
  ShapeLibrary shapes;
  std::vector<Vec3d> at;
  for (int i = 0; i < side * side * side; ++i)
    at.push_back(Vec3d{kApart * (i % side), kApart * (i / side % side), kApart * (i / side / side)} - Vec3d{middle, middle, middle});
  Tissue tissue = test::make_tissue(model, shapes, at, std::vector<BodyKind>(at.size(), BodyKind::kSphere));
  tissue.obstacle_offset.resize(model.obstacles.size());
  Mechanics mechanics(model, contact_obstacles(model).value(), shapes, Comm(), 2);
  std::vector<Vec3d> force(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) force[i] = tissue.spheres.position[i] * 0.005 + Vec3d{1.0, 0.5, 0};
  const auto report = mechanics.step(tissue, kStep, mechanics.spread(tissue, force));
  EXPECT_TRUE(report.ok()) << report.error().what;
  return report.ok() ? report->way / report->displacement : -1.0;
}

/// What is left is that no single point may go further than three times as far as a tissue.
TEST(WayOfBodies, WhatAThousandSpheresDoInCommonDoesNotCount) {
  EXPECT_NEAR(counted_of_swelling(10, false), 1.0 / kLoneFree, 1e-6);
  EXPECT_GT(counted_of_swelling(9, false), 1.6);
  EXPECT_GT(counted_of_swelling(10, true), 1.6);
}

}  // namespace
}  // namespace morula
