#include <gtest/gtest.h>

#include <cmath>

#include "core/contact/contact_layer.h"
#include "coupling/mechanics/scene.h"
#include "tests/coupling/friction_sums.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kMedium = 0.1, kDamping = 0.4, kBulkViscosity = 0.3, kContact = 20.0;

/// Two cells with all kinds of friction, that are pressed together and far from rest.
Model model_with_all_friction() {
  Model model = test::clusters_model(0.2);
  dcm::ShellParameters& shell = model.types[0].shell;
  shell.medium_friction = model.types[0].medium_friction = kMedium;
  shell.edge_damping = kDamping;
  shell.bulk_viscosity = kBulkViscosity;
  model.pairs = {ContactPair{0.2, kContact, kContact}};
  model.contact.range = 0.6;
  model.step.integrator = Integrator::kExplicitEuler;
  return model;
}

/// vᵀΓv by the definitions of dcm.md §1 and §5: Σ γ a |v|² of nodes + Σ γ_int (t·(v_i − v_j))² of edges + (η_V/V)(u·v)² with u = ∂V/∂x of
/// cells + Σ w γ |u|² of contact points.
double dissipation(const dcm::Shells& shells, const std::vector<test::RubbingPoint>& contacts, const std::vector<Vec3d>& v) {
  double sum = test::contact_dissipation(contacts, kContact, v);
  const auto area = test::node_areas(shells);
  for (std::size_t i = 0; i < v.size(); ++i) sum += kMedium * area[i] * norm2(v[i]);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const std::uint32_t first = shells.first_node[s];
    for (const Edge& edge : shells.topology(s).edges()) {
      const std::uint32_t i = first + edge.i, j = first + edge.j;
      const double rate = dot(normalized(shells.position[i] - shells.position[j]), v[i] - v[j]);
      sum += kDamping * rate * rate;
    }
    double volume = 0.0, change = 0.0;
    const Vec3d& origin = shells.position[first];
    for (const Triangle& t : shells.topology(s).faces()) {
      const Vec3d x[3] = {shells.position[first + t[0]] - origin, shells.position[first + t[1]] - origin,
                          shells.position[first + t[2]] - origin};
      volume += dot(x[0], cross(x[1], x[2])) / 6.0;
      for (std::size_t c = 0; c < 3; ++c) change += dot(v[first + t[c]] - v[first], cross(x[(c + 1) % 3], x[(c + 2) % 3])) / 6.0;
    }
    sum += kBulkViscosity / volume * change * change;
  }
  return sum;
}

/// dcm.md T9.5: −dE/dt = vᵀΓv, explicit to O(Δt): E(x + Δt v) = E − Δt F·v + ½ Δt² vᵀKv, and F = Γv.
TEST(ExplicitStep, LosesAsMuchEnergyAsFrictionTakes) {
  const Model model = model_with_all_friction();
  ShapeLibrary shapes;
  Tissue start = test::make_tissue(model, shapes, {{0, 0, 0}, {11.8, 0.3, 0.2}}, {BodyKind::kShell, BodyKind::kShell});
  for (std::size_t s = 0; s < 2; ++s)  // out of rest in volume, area and shape
    for (Vec3d& x : start.shells.nodes(s)) x.z *= 1.08;
  constexpr double kStep = 4e-3;
  double error[3];
  for (const int part : {0, 1, 2}) {
    const double dt = kStep / (1 << part);
    Mechanics mechanics(model, {}, shapes, Comm(), 1);
    std::vector<Vec3d> force;
    const double before = mechanics.energy_and_forces(start, force);
    const Scene& scene = mechanics.scene();
    const auto contacts =
        test::rubbing_points(mechanics.contacts(), {scene.bodies(), scene.position(), scene.topologies(), scene.first_face()});
    ASSERT_GT(contacts.size(), 20u);
    Tissue moved = start;
    const auto report = mechanics.step(moved, dt, std::vector<Vec3d>(force.size()));
    ASSERT_TRUE(report.ok()) << report.error().what;
    std::vector<Vec3d> v;
    for (std::size_t i = 0; i < force.size(); ++i) v.push_back((moved.shells.position[i] - start.shells.position[i]) * (1.0 / dt));
    const double taken = dissipation(start.shells, contacts, v);
    EXPECT_GT(test::contact_dissipation(contacts, kContact, v), 0.01 * taken);
    error[part] = (before - report->energy) / dt / taken - 1.0;
  }
  EXPECT_LT(error[0], -1e-3);  // as ½ Δt vᵀKv has it
  EXPECT_NEAR(error[0] / error[1], 2.0, 0.1);
  EXPECT_NEAR(error[1] / error[2], 2.0, 0.1);
  EXPECT_NEAR(2.0 * error[2] - error[1], 0.0, 2e-5);  // extrapolated to Δt = 0, beside errors of 9e-3 to 2e-3
}

}  // namespace
}  // namespace morula
