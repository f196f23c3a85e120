/// What every law of contact between surfaces must give, whatever its form.
#include <gtest/gtest.h>

#include "core/mesh/primitives.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

class EveryContactLaw : public testing::TestWithParam<SurfaceLaw> {};

constexpr double kRadius = 6.0, kAdhesion = 0.1;

/// Cells against a large plate whose upper face is at z = 0.
Model above_a_plate(SurfaceLaw law) {
  Model model = test::clusters_model(0.0);
  model.contact.range = 0.5;
  model.contact.repulsion = 100.0;
  const auto box = make_box({40.0, 40.0, 4.0}, 40.0);
  TriangleMesh plate = *box;
  for (Vec3d& p : plate.position) p.z -= 2.0;
  model.obstacles = {ObstacleSpec{"plate", plate.position, plate.faces, false, {}}};
  ContactPair pair{kAdhesion, 50.0, 50.0};
  pair.law = law;
  pair.reduced_modulus = 20.0;
  model.pairs = {model.pairs[0], pair, pair, pair};
  return model;
}

/// dcm.md T7.2: a rigid sphere is pulled off a plane by 2πRW for any range of the traction (Archimedes), and the work is W by area.
TEST_P(EveryContactLaw, PullsARigidSphereOffAPlaneAtTwoPiRW) {
  const Model model = above_a_plate(GetParam());
  ShapeLibrary shapes;
  double strongest = 0.0;
  for (double gap = -0.02; gap < 0.6; gap += 0.02) {
    Tissue tissue = test::make_tissue(model, shapes, {{0.3, 0.2, kRadius + gap}}, {BodyKind::kShell}, 2562, kRadius);
    tissue.obstacle_offset.resize(1);
    auto obstacles = contact_obstacles(model);
    ASSERT_TRUE(obstacles.ok());
    Mechanics mechanics(model, std::move(*obstacles), shapes, Comm(), 1);
    strongest = std::max(strongest, mechanics.obstacle_forces(tissue)[0].z);
  }
  const double exact = 2.0 * std::numbers::pi * kRadius * kAdhesion;  // 3.7699 nN
  EXPECT_NEAR(strongest, exact, 0.015 * exact);                       // table of dcm.md §7: 0.999 ± 0.002, and steps of the gap
}

/// A shell let go beside a plate sticks to it and rests, without deep overlap, and the plate holds it with no net force.
TEST_P(EveryContactLaw, LetsAShellRestOnAPlane) {
  const Model model = above_a_plate(GetParam());
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0.3, 0.2, kRadius + 0.1}}, {BodyKind::kShell}, 162, kRadius);
  tissue.obstacle_offset.resize(1);
  auto obstacles = contact_obstacles(model);
  ASSERT_TRUE(obstacles.ok());
  Mechanics mechanics(model, std::move(*obstacles), shapes, Comm(), 1);
  const std::vector<Vec3d> none(Mechanics::external_size(tissue));
  double dt = 1.0, energy = 1e300;
  for (int step = 0; step < 80; ++step) {
    auto report = mechanics.step(tissue, dt, none);
    for (int retry = 0; !report.ok() && retry < 10; ++retry) report = mechanics.step(tissue, dt *= 0.5, none);
    ASSERT_TRUE(report.ok()) << report.error().what;
    EXPECT_LE(report->energy, energy + 1e-9) << "step " << step;
    energy = report->energy;
    if (report->displacement < 0.1) dt = std::min(120.0, 1.5 * dt);
  }
  const double flat = 4.0 / 3.0 * std::numbers::pi;  // a part of what Young's angle would give
  EXPECT_GT(mechanics.values(tissue).contact_area[0], flat);
  EXPECT_LT(std::abs(mechanics.obstacle_forces(tissue)[0].z), 0.02);
  EXPECT_LT(mechanics.deepest_overlap(), 0.3);
}

std::string name_of(const testing::TestParamInfo<SurfaceLaw>& given) {
  const char* const names[] = {"Tent", "MaugisDugdale", "Falling"};
  return names[static_cast<std::size_t>(given.param)];
}

INSTANTIATE_TEST_SUITE_P(Every, EveryContactLaw, testing::Values(SurfaceLaw::kTent, SurfaceLaw::kMaugisDugdale, SurfaceLaw::kFalling),
                         name_of);

}  // namespace
}  // namespace morula
