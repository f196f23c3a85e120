/// What every law of contact between surfaces must give, whatever its form.
#include <gtest/gtest.h>

#include "core/mesh/primitives.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

class EveryContactLaw : public testing::TestWithParam<std::shared_ptr<const SurfaceLaw>> {};

constexpr double kRadius = 6.0, kAdhesion = 0.1;

/// Cells against a large plate whose upper face is at z = 0.
Model above_a_plate(const std::shared_ptr<const SurfaceLaw>& law) {
  Model model = test::clusters_model(0.0);
  model.contact.range = 0.5;
  model.contact.repulsion = 100.0;
  const auto box = make_box({40.0, 40.0, 4.0}, 40.0);
  TriangleMesh plate = *box;
  for (Vec3d& p : plate.position) p.z -= 2.0;
  model.obstacles = {ObstacleSpec{"plate", plate.position, plate.faces, false, {}}};
  ContactPair pair{kAdhesion, 50.0, 50.0};
  pair.law = law;
  pair.own.set("modulus", 20.0);
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

/// T7.2: the same for any range below 2 R: Archimedes, a zone of a sphere between two planes has the area 2π R times their distance.
TEST(RigidSphere, IsPulledOffAPlaneByTheSameForceWhateverTheRange) {
  for (const double range : {0.25, 1.0, 2.0}) {
    Model model = above_a_plate(tent_law());
    model.contact.range = range;
    ShapeLibrary shapes;
    Tissue tissue = test::make_tissue(model, shapes, {{0.3, 0.2, kRadius}}, {BodyKind::kShell}, 2562, kRadius);
    tissue.obstacle_offset.resize(1);
    Mechanics mechanics(model, contact_obstacles(model).value(), shapes, Comm(), 1);
    double strongest = 0.0;
    for (int k = -4; k <= 12; ++k) {
      Tissue at = tissue;
      for (Vec3d& x : at.shells.position) x.z += 0.01 * range * k;
      mechanics.bodies_changed();
      strongest = std::max(strongest, mechanics.obstacle_forces(at)[0].z);
    }
    EXPECT_NEAR(strongest / 3.7699, 1.0, 0.006) << range;  // table of dcm.md §7 at c = 0.2 µm: 1.000 ± 0.006
  }
}

/// T7.2: two spheres by 2π R_eff W, R_eff = R1 R2/(R1 + R2), to O(c/R). The terms beyond: points of sphere 1 at the distance r from the
/// centre of sphere 2, D away, have the area 2π R1 r dr/D, so that E1 = (2π R1/D) ∫ U(g) (g + R2) dg and at contact dE1/dD = 2π R_eff W −
/// E1/D. With ∫ U dg = −W c/2 and ∫ g U dg = −7 W c²/48 of the tent, both spheres being sources of half the energy,
/// F = 2π R_eff W [1 + c/(2D) + 7c² (1/R1 + 1/R2)/(96 D)].
TEST(RigidSphere, IsPulledOffASphereByItsEffectiveRadius) {
  for (const double other : {6.0, 3.0}) {
    for (const double range : {0.4, 0.8}) {
      Model model = test::clusters_model(kAdhesion);
      model.contact.range = range;
      ShapeLibrary shapes;
      Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {0, 0, kRadius + other}}, {BodyKind::kShell, BodyKind::kShell}, 2562);
      dcm::ShellParameters& p = model.types[0].shell;
      p.spring_stiffness = p.hinge_stiffness = p.tension = p.bulk_modulus = p.shape_stiffness = p.barrier_stiffness = 0.0;
      const std::size_t upper = tissue.shells.nodes(0)[0].z > kRadius ? 0 : 1;
      const Vec3d center{0, 0, kRadius + other};
      for (Vec3d& x : tissue.shells.nodes(upper)) x = center + (x - center) * (other / kRadius);
      Mechanics mechanics(model, {}, shapes, Comm(), 1);
      double strongest = 0.0;
      for (int k = -3; k <= 8; ++k) {
        Tissue at = tissue;
        for (Vec3d& x : at.shells.nodes(upper)) x.z += 0.01 * range * k;
        mechanics.bodies_changed();
        std::vector<Vec3d> force;
        (void)mechanics.energy_and_forces(at, force);
        double pull = 0.0;
        for (std::uint32_t i = at.shells.first_node[upper]; i < at.shells.first_node[upper + 1]; ++i) pull -= force[i].z;
        strongest = std::max(strongest, pull);
      }
      const double apart = kRadius + other, curvature = 1.0 / kRadius + 1.0 / other;
      const double exact =
          2.0 * std::numbers::pi / curvature * kAdhesion * (1.0 + range / (2.0 * apart) + 7.0 * range * range * curvature / (96.0 * apart));
      EXPECT_NEAR(strongest / exact, 1.0, 0.006) << other << ' ' << range;  // the mesh, as for the plane
    }
  }
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

std::string name_of(const testing::TestParamInfo<std::shared_ptr<const SurfaceLaw>>& given) { return given.param->info.name; }

INSTANTIATE_TEST_SUITE_P(Every, EveryContactLaw, testing::ValuesIn(surface_laws()), name_of);

}  // namespace
}  // namespace morula
