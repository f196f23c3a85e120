#include <gtest/gtest.h>

#include "coupling/simulation.h"
#include "tests/coupling/friction_sums.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

/// Two equal cells that adhere (scenarios.md S6): fluid cortices, W/T = 1.
Model doublet_model() {
  Model model = test::clusters_model(0.1);
  CellType& type = model.types[0];
  type.shell.spring_stiffness = 0.0;
  type.shell.hinge_stiffness = 0.0;
  type.shell.tension = 0.1;
  type.shell.shape_stiffness = 0.06;
  type.medium_friction = 0.1;
  model.pairs = {ContactPair{0.1, 0.1, 0.1}};
  model.contact.range = 0.5;
  model.contact.repulsion = 20.0;
  model.contact.points_per_face = 3;
  model.step.max_step = 10.0;
  model.step.initial_step = 0.1;
  return model;
}

/// How far the pair as a whole has been pushed and turned in ten minutes, in radii: displacements weighted by the friction with the medium,
/// the only force from outside. Without inertia this is what has to be zero; the centre of mass is free to move with a mesh that flows unevenly.
struct Drift {
  double push = 0.0, turn = 0.0;
};

Drift drift_of_doublet(const Model& model) {
  const double radius = 6.0;
  ShapeLibrary shapes;
  const Tissue tissue = test::make_tissue(model, shapes, {{0, 0, -radius}, {0, 0, radius}}, std::vector<BodyKind>(2, BodyKind::kShell));
  auto s = std::move(Simulation::create(model, tissue, Comm(), 1)).value();
  Vec3d push{}, turn{};
  while (s->tissue().clock.time < 600.0) {
    const dcm::Shells& shells = s->tissue().shells;
    const auto area = test::node_areas(shells);
    const auto before = shells.position;
    if (!s->step(600.0).ok()) return {1e300, 1e300};
    double all = 0.0;
    for (const double a : area) all += a;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Vec3d way = (area[i] / all) * (shells.position[i] - before[i]);
      push += way;
      turn += cross(before[i], way);
    }
  }
  const auto centers = s->centers();
  EXPECT_LT(norm(centers[1] - centers[0]), 1.4 * radius);  // they have flattened against each other
  return {norm(push) / radius, norm(turn) / (radius * radius)};
}

TEST(Doublet, IsNeitherPushedNorTurnedByItsOwnForces) {
  Model model = doublet_model();
  model.step.first_tolerance = model.step.later_tolerance = 1e-7;
  model.step.newton_stop = 1e-6;
  model.step.max_newton = 30;
  const Drift drift = drift_of_doublet(model);  // measured: 3e-10 and 6e-7; with tolerances of 1e-6 2e-10 and 2.6e-6
  EXPECT_LE(drift.push, 1e-8);
  EXPECT_LE(drift.turn, 1e-5);
}

TEST(Doublet, IsPushedByLessThanAHundredthOfARadiusWithTheDefaultTolerances) {
  const Drift drift = drift_of_doublet(doublet_model());  // measured: 1.3e-3 and below 1e-3
  EXPECT_LE(drift.push, 0.01);
  EXPECT_LE(drift.turn, 0.01);
}

}  // namespace
}  // namespace morula
