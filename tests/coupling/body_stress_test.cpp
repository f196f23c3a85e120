/// One stress and one pressure for both bodies (fields_and_coupling.md, D; decisions 0023, 0054).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/simulation.h"
#include "coupling/swaps.h"
#include "tests/coupling/exact_steps.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

using B = BodyKind;

constexpr double kTension = 0.2;

/// A cortex that flows: tension, volume and a little of the triangles' shape.
Model fluid_model(double adhesion) {
  Model model = test::clusters_model(adhesion);
  dcm::ShellParameters& shell = model.types[0].shell;
  shell.tension = kTension;
  shell.spring_stiffness = shell.hinge_stiffness = 0.0;
  shell.shape_stiffness = 0.02;
  shell.barrier_stiffness = 1.0;
  model.contact.range = 0.5;
  model.contact.repulsion = 100.0;
  model.contact.points_per_face = 3;
  test::solve_exactly(model.step);
  return model;
}

double trace(const SymMat3<double>& m) { return m.xx + m.yy + m.zz; }

/// p_in − p = 2γA/(3V): the virial of a cell at rest whose surface has the tension γ everywhere, whoever presses on it or pulls at it; without
/// adhesion. The triangles' shape adds no more than its energy: 0.5 %.
void expect_virial(const BodyValues& values, std::size_t shell) {
  const double cortex = 2.0 * kTension * values.area[shell] / (3.0 * values.volume[shell]);
  EXPECT_NEAR((values.inner_pressure[shell] - values.pressure[shell]) / cortex, 1.0, 5e-3);
  EXPECT_DOUBLE_EQ(values.pressure[shell], -trace(values.stress[shell]) / 3.0);
}

TEST(BodyStress, OfAFreeShellIsZeroAndItsInnerPressureThatOfLaplace) {
  const Model model = fluid_model(0.1);
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {40, 0, 0}}, {B::kShell, B::kSphere});
  ASSERT_LT(test::relax(model, tissue, 1e-5, 5.0), 1e-5);
  const BodyValues values = Mechanics(model, {}, shapes, Comm(), 1).values(tissue);
  for (const std::size_t cell : {0u, 1u}) EXPECT_LT(std::abs(values.pressure[cell]), 1e-12);
  EXPECT_NEAR(values.inner_pressure[0], 2.0 * kTension / 6.0, 0.02 * 2.0 * kTension / 6.0);  // 162 nodes: + 1.4 % (T4.1)
  EXPECT_EQ(values.inner_pressure[1], values.pressure[1]);
  expect_virial(values, 0);
}

/// A free doublet bears nothing from outside, however strongly it adheres: adhesion is a tension of the interface (Young), W/2 less than the cortex
/// on either side. So p = 0 and p_in = (2γA − W A_c)/(3V).
TEST(BodyStress, OfADoubletAtRestIsZeroAndItsInterfaceHasLessTension) {
  const double adhesion = 0.15;
  const Model model = fluid_model(adhesion);
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, -5.8}, {0, 0, 5.8}}, {B::kShell, B::kShell});
  ASSERT_LT(test::relax(model, tissue, 1e-3, 10.0), 1e-3);
  const BodyValues values = Mechanics(model, {}, shapes, Comm(), 1).values(tissue);
  EXPECT_GT(values.contact_area[0], 15.0);
  for (const std::size_t cell : {0u, 1u}) {
    // The told area counts all within half the range, a fifth too much at this W (time_stepping.md §12.3).
    const double of_adhesion = adhesion * values.contact_area[cell] / (3.0 * values.volume[cell]);
    const double of_cortex = 2.0 * kTension * values.area[cell] / (3.0 * values.volume[cell]);
    EXPECT_LT(std::abs(values.pressure[cell]), 0.2 * of_adhesion);  // forces within the gap of the wedge
    const double less = (of_cortex - (values.inner_pressure[cell] - values.pressure[cell])) / of_adhesion;
    EXPECT_LT(less, 1.05);
    EXPECT_GT(less, 0.7);
    for (const double part : {values.stress[cell].xx, values.stress[cell].yy, values.stress[cell].zz})
      EXPECT_LT(std::abs(part), 0.5 * of_adhesion);
  }
}

/// A cell pulled at its ends: the loads count as what others exert.
TEST(BodyStress, HoldsTheLoads) {
  Model model = fluid_model(0.0);
  CellLoad pull;
  pull.what = pull_load();
  pull.axis = {0, 0, 1};
  pull.size = 0.4;
  pull.part = 0.1;
  model.loads = {pull};
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {B::kShell});
  auto simulation = std::move(Simulation::create(model, tissue, Comm(), 1)).value();
  while (simulation->tissue().clock.time < 600.0) ASSERT_TRUE(simulation->step(600.0).ok());
  const BodyValues values = simulation->values();
  expect_virial(values, 0);
  EXPECT_GT(values.stress[0].zz, 0.4 * 9.0 / values.volume[0]);  // two forces, each the cell's half length or a little less from the middle
  EXPECT_LT(values.stress[0].zz, 0.4 * 16.0 / values.volume[0]);
  EXPECT_LT(std::abs(values.stress[0].xx), 0.02 * values.stress[0].zz);
  EXPECT_LT(values.pressure[0], 0.0);
}

/// A sphere pushed with 2 nN onto a shell that is held by its whole: the same area, and a pressure of force times way over 3V on either side.
TEST(BodyStress, IsThatOfTheForceWhereASphereIsPushedOntoAShell) {
  Model model = fluid_model(0.0);
  model.types[0].shell.tension = 1.0;  // the contact stays small: its place is known without its shape
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {0, 0, 11.8}}, {B::kShell, B::kSphere});
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  const std::vector<Vec3d> push{{0, 0, 2.0}, {0, 0, -2.0}};
  std::vector<Vec3d> force(1);
  double dt = 0.05;
  for (int k = 0; k < 400 && std::abs(force.back().z - 2.0) > 0.05; ++k) {
    if (!mechanics.step(tissue, dt, mechanics.spread(tissue, push)).ok()) {
      dt *= 0.5;
      continue;
    }
    tissue.clock.time += dt;
    dt = std::min(20.0, 1.3 * dt);
    (void)mechanics.energy_and_forces(tissue, force);
  }
  const double pressing = force.back().z;  // what is left drives the last creep
  ASSERT_NEAR(pressing, 2.0, 0.05);
  const BodyValues values = mechanics.values(tissue);
  EXPECT_GT(values.contact_area[0], 6.0);  // 2 nN against 2γ/R = 0.33 kPa and more
  EXPECT_NEAR(values.contact_area[0] / values.contact_area[1], 1.0, 1e-6);
  const double middle = volume_centroid(tissue.shells.topology(0).faces(), tissue.shells.nodes(0)).z;
  const double way = tissue.spheres.position[0].z - middle;  // both arms
  const double of_shell = -values.stress[0].zz * values.volume[0], of_sphere = -values.stress[1].zz * values.volume[1];
  EXPECT_NEAR(of_shell + of_sphere, pressing * way, 0.03 * pressing * way);
  EXPECT_NEAR(of_shell / of_sphere, 1.0, 0.1);
  // Tractions across the line of centres count on the shell alone: they do not sum to a force on the sphere.
  EXPECT_NEAR(values.pressure[0] / values.pressure[1], 1.0, 0.15);
  EXPECT_LT(std::abs(values.stress[1].xx), 1e-2 * std::abs(values.stress[1].zz));
}

TEST(BodyStress, ArmsOfUnequalSpheresSumToTheirDistance) {
  const Model model = fluid_model(0.0);
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {9, 0, 0}}, {B::kSphere, B::kSphere});
  tissue.spheres.radius = {6.0, 4.0};
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  std::vector<Vec3d> force;
  (void)mechanics.energy_and_forces(tissue, force);
  const BodyValues values = mechanics.values(tissue);
  // The contact is in the middle of the overlap of 1 µm: 5.5 and 3.5 µm from the centres.
  EXPECT_NEAR(3.0 * values.pressure[0] * values.volume[0] / (norm(force[0]) * 5.5), 1.0, 2e-2);  // V is a little less than the ball
  EXPECT_NEAR(3.0 * values.pressure[1] * values.volume[1] / (norm(force[1]) * 3.5), 1.0, 2e-2);
  EXPECT_NEAR(values.stress[0].xx, -3.0 * values.pressure[0], 1e-12);
}

/// At the beginning of a run spheres that touch adhere already: JKR, not Hertz.
TEST(BodyStress, FlagsOfContactsAreSetBeforeTheFirstStep) {
  const Model model = test::clusters_model(0.1);
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {9, 0, 0}}, {B::kSphere, B::kSphere}, 162, 5.0);
  auto simulation = std::move(Simulation::create(model, tissue, Comm(), 1)).value();
  ASSERT_TRUE(simulation->first_swaps().ok());
  // Reference pair at δ = 1: F = −0.3592068 nN (physics page).
  const double ball = 4.0 / 3.0 * std::numbers::pi * 125.0;
  for (const double p : simulation->values().pressure) EXPECT_NEAR(p, -9.0 * 0.3592068 / (6.0 * ball), 1e-2 * 0.003);
  const auto again = simulation->values();
  ASSERT_TRUE(simulation->first_swaps().ok());
  EXPECT_EQ(simulation->values().pressure, again.pressure);
}

TEST(BodyStress, OfASphereUnderTensionIsKeptByItsShell) {
  Model model = test::clusters_model(0.1);
  ShapeLibrary shapes;
  const Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {B::kSphere});
  for (const double p : {-0.03, 0.0, 0.2}) {
    Tissue copy = tissue;
    auto cells = take_apart(copy);
    promote(cells[0], model.types[0], p, 0.0, shapes, 1);
    const ShellRecord& shell = *cells[0].shell;
    const double volume = enclosed_volume(shell.shape->topology->faces(), shell.position, {});
    EXPECT_NEAR(volume / cells[0].row.target_volume, std::exp(-p / 2.5), 1e-9);
    // −K_V ln(V/V0) = p + 2γ/R, R the radius of the free cell
    EXPECT_NEAR(2.5 * std::log(cells[0].shell->reference_volume / volume), p + 2.0 * 0.5 / 6.0, 1e-9);
  }
}

}  // namespace
}  // namespace morula
