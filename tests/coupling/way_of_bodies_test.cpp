/// How far a tissue goes in a step, where few of many go (decision 0058).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kStep = 1.0;      // [s]
constexpr double kApart = 40.0;    // [µm]: nobody touches
constexpr double kLoneFree = 3.0;  // how many times as far as a body a point may go

struct Bodies {
  int spheres = 0, shells = 0;
};

/// Way over displacement of a step in which one sphere is pulled, or one shell, and nobody else goes anywhere.
double counted(const Bodies& bodies, BodyKind pulled) {
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
  const std::size_t shells = tissue.shells.size();
  std::vector<Vec3d> force(tissue.cells.size());
  force[pulled == BodyKind::kShell ? 0 : shells] = {2.0, 0, 0};  // by body: shells, then spheres
  const auto report = mechanics.step(tissue, kStep, mechanics.spread(tissue, force));
  EXPECT_TRUE(report.ok()) << report.error().what;
  return report.ok() ? report->way / report->displacement : -1.0;
}

/// One of n counts 1.7 n^(-1/4), no more than whole and no less than a third: nobody goes further than a point may.
double lone_of(int n) { return std::max(1.0 / kLoneFree, std::min(1.0, 1.7 * std::pow(n, -0.25))); }

TEST(WayOfBodies, OneOfManySpheresCountsLess) {
  for (const int n : {1, 5, 8, 16, 81, 256, 1000}) EXPECT_NEAR(counted({.spheres = n}, BodyKind::kSphere), lone_of(n), 1e-3) << n;
}

TEST(WayOfBodies, ShellsAreComparedWithShellsAndSpheresWithSpheres) {
  EXPECT_NEAR(counted({.spheres = 300, .shells = 1}, BodyKind::kShell), 1.0, 0.02);
  EXPECT_NEAR(counted({.spheres = 1, .shells = 30}, BodyKind::kSphere), 1.0, 0.02);
  EXPECT_NEAR(counted({.spheres = 1, .shells = 40}, BodyKind::kShell), lone_of(40), 0.02);
}

}  // namespace
}  // namespace morula
