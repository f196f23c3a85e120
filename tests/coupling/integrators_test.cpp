/// The two ways in which a step can be done, against closed forms and against each other (dcm.md §1).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random/philox.h"
#include "dcm/builtin.h"
#include "tests/coupling/exact_steps.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kMedium = 0.1;  // friction per area [nN·s/µm³]

/// Nodes after so many steps of equal length.
std::vector<Vec3d> run(const Model& model, Tissue tissue, double time, int steps) {
  ShapeLibrary shapes;
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  const std::vector<Vec3d> external(Mechanics::external_size(tissue));
  for (int k = 0; k < steps; ++k) {
    const auto report = mechanics.step(tissue, time / steps, external);
    EXPECT_TRUE(report.ok()) << report.error().what;
    if (!report.ok()) break;
    tissue.clock.time += time / steps;
  }
  return tissue.shells.position;
}

/// T1.1: a force spread by area moves all nodes with f/(γ_ECM ΣA), equal to 1e-10, whatever else the cell is made of. The solver keeps
/// vectors in single precision; a second solve for what the first has left gives the digits.
TEST(ImplicitStep, MovesAllNodesAlikeUnderAForceSpreadByArea) {
  Model model = test::clusters_model();
  dcm::ShellParameters& shell = model.types[0].shell;
  shell.medium_friction = kMedium;
  shell.tension = shell.shape_stiffness = 0.0;  // at rest as it is made: springs, hinges, volume
  shell.edge_damping = 0.4;
  shell.bulk_viscosity = 0.3;
  test::solve_exactly(model.step);
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  tissue.shells.reference_volume = tissue.shells.rest_volume;
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  const std::vector<Vec3d> start = tissue.shells.position;
  const double area = mechanics.values(tissue).area[0], dt = 2.0;
  const Vec3d force{0.6, -1.2, 2.4};
  const auto report = mechanics.step(tissue, dt, mechanics.spread(tissue, std::vector{force}));
  ASSERT_TRUE(report.ok()) << report.error().what;
  const Vec3d expected = force * (1.0 / (kMedium * area));
  for (std::size_t i = 0; i < start.size(); ++i)
    EXPECT_LT(norm((tissue.shells.position[i] - start[i]) * (1.0 / dt) - expected), 1e-10 * norm(expected)) << i;
}

/// T5.5 of dcm.md as motion: swollen by a little, a cell of volume pressure alone shrinks with 12.31, 12.45 and 12.49 /s (± 2 %; 3K_V/(R γ)
/// = 12.5).
TEST(ExplicitStep, ShrinksASwollenCellAtTheRateOfItsBreathingMode) {
  const double published[] = {12.31, 12.45, 12.49};
  const std::uint32_t nodes[] = {162, 642, 2562};
  for (int level = 0; level < 3; ++level) {
    Model model = test::clusters_model();
    model.types[0].shell = {};
    dcm::ShellParameters& shell = model.types[0].shell;
    shell.edge_damping = shell.shape_stiffness = shell.barrier_stiffness = 0.0;
    shell.bulk_modulus = 2.5;
    shell.medium_friction = kMedium;
    model.step.integrator = Integrator::kExplicitEuler;
    ShapeLibrary shapes;
    Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, nodes[level]);
    for (Vec3d& x : tissue.shells.position) x *= 6.0 / norm(x);  // the published numbers are for nodes on the sphere
    Mechanics mechanics(model, {}, shapes, Comm(), 1);
    const double rest = mechanics.values(tissue).volume[0];
    tissue.shells.reference_volume[0] = rest;
    constexpr double kSwelling = 1e-5, kStep = 1e-6;
    for (Vec3d& x : tissue.shells.position) x *= std::cbrt(1.0 + kSwelling);
    mechanics.bodies_changed();
    const double before = mechanics.values(tissue).volume[0];
    ASSERT_TRUE(mechanics.step(tissue, kStep, std::vector<Vec3d>(nodes[level])).ok());
    const double after = mechanics.values(tissue).volume[0];
    EXPECT_NEAR((before - after) / kStep / (before - rest), published[level], 0.006) << nodes[level];
  }
}

/// T2.3 of dcm.md for all edges of a shell at once: L − L0 = (f/k)(1 − e^{−t/τ}), τ = γ_int/k = 0.57735 s, ± 1 % at Δt = τ/200. With forces
/// k ε Σ_j (x_i − x_j) on the nodes, j the neighbours of i, every edge bears f = k ε L0, and a shell of springs and dampers alone grows by
/// 1 + ε (1 − e^{−t/τ}) without turning an edge, so that this holds at any ε.
class KelvinVoigtShell : public testing::TestWithParam<Integrator> {};

TEST_P(KelvinVoigtShell, CreepsUnderAStepOfForce) {
  constexpr double kSpring = 0.173205, kDamper = 0.1, kStrain = 0.05, kTau = kDamper / kSpring;
  Model model = test::clusters_model();
  dcm::ShellParameters& shell = model.types[0].shell;
  shell = {};
  shell.spring_stiffness = kSpring;
  shell.edge_damping = kDamper;
  shell.bulk_modulus = shell.shape_stiffness = shell.barrier_stiffness = 0.0;
  shell.medium_friction = model.types[0].medium_friction = 1e-6;  // for rigid motion; γ a is 1e-4 of the damper
  model.step.integrator = GetParam();
  test::solve_exactly(model.step);
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 42);
  tissue.shells.reference_volume = tissue.shells.rest_volume;
  const auto edges = tissue.shells.topology(0).edges();
  std::vector<Vec3d> force(42);
  for (const Edge& edge : edges) {
    const Vec3d pull = (tissue.shells.position[edge.i] - tissue.shells.position[edge.j]) * (kSpring * kStrain);
    force[edge.i] += pull, force[edge.j] -= pull;
  }
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  for (int step = 1; step <= 400; ++step) {
    ASSERT_TRUE(mechanics.step(tissue, kTau / 200.0, force).ok());
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const double rest = tissue.shells.rest_length[e], load = kSpring * kStrain * rest;
      const double length = norm(tissue.shells.position[edges[e].i] - tissue.shells.position[edges[e].j]);
      ASSERT_NEAR((length - rest) / (load / kSpring * (1.0 - std::exp(-step / 200.0))), 1.0, 0.01) << "step " << step << ", edge " << e;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Both, KelvinVoigtShell, testing::Values(Integrator::kImplicit, Integrator::kExplicitEuler),
                         [](const auto& given) { return given.param == Integrator::kImplicit ? "Implicit" : "Explicit"; });

/// A cell with all that a cortex can have, squeezed to an ellipsoid of its volume and roughened.
Model rich_model() {
  Model model = test::clusters_model();
  CellType& type = model.types[0];
  type.shell.sheets = {{dcm::shell_law("neo_hooke").sheet, {0.05, 1.0}}};
  type.shell.local_area_modulus = 0.05;
  type.shell.global_area_modulus = 0.05;
  type.shell.helfrich_rigidity = 8.9e-4;
  type.shell.edge_damping = 0.1;
  type.shell.bulk_viscosity = 0.1;
  type.medium_normal_extra = 0.05;
  model.contact.range = 1.0;
  test::solve_exactly(model.step);
  return model;
}

Tissue squeezed_cell(const Model& model, ShapeLibrary& shapes) {
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  const Random random(5, RandomStream::kInitialPosition);
  std::uint64_t n = 0;
  for (Vec3d& x : tissue.shells.position) x = Vec3d{1.15 * x.x, x.y, x.z / 1.15} + random.direction(CellId(1), n++) * 0.02;
  return tissue;
}

double largest(const std::vector<Vec3d>& a) {
  double most = 0.0;
  for (const Vec3d& v : a) most = std::max(most, norm(v));
  return most;
}
std::vector<Vec3d> sum(const std::vector<Vec3d>& a, double factor, const std::vector<Vec3d>& b) {
  std::vector<Vec3d> out;
  for (std::size_t i = 0; i < a.size(); ++i) out.push_back(a[i] + b[i] * factor);
  return out;
}

/// Explicit Euler needs no linearisation: both go to the same motion, each with an error of first order in Δt (dcm.md §1), so that their
/// difference halves with Δt and nothing is left of it at Δt = 0.
TEST(ImplicitStep, GoesToExplicitEulerAsTheStepGoesToZero) {
  Model implicit = rich_model(), by_euler = rich_model();
  by_euler.step.integrator = Integrator::kExplicitEuler;
  ShapeLibrary shapes;
  const Tissue tissue = squeezed_cell(implicit, shapes);
  constexpr double kTime = 0.16;
  std::vector<Vec3d> difference[3], position[2][3];
  for (int level = 0; level < 3; ++level) {
    const int steps = 20 << level;
    position[0][level] = run(implicit, tissue, kTime, steps);
    position[1][level] = run(by_euler, tissue, kTime, steps);
    difference[level] = sum(position[0][level], -1.0, position[1][level]);
  }
  const double way = largest(sum(position[1][2], -1.0, tissue.shells.position));
  EXPECT_GT(way, 0.05);
  EXPECT_LT(largest(difference[0]), 0.2 * way);
  for (int level = 0; level < 2; ++level) EXPECT_NEAR(largest(difference[level]) / largest(difference[level + 1]), 2.0, 0.01);
  // what is left at Δt = 0, extrapolated from the two finest (measured: 6e-8 of 2e-4 µm)
  EXPECT_LT(largest(sum(difference[1], -2.0, difference[2])), 0.002 * largest(difference[1]));
}

}  // namespace
}  // namespace morula
