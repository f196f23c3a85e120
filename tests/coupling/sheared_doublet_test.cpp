/// A doublet with a flat contact that moves without changing its shape: what holds it back is the medium and the friction of the contact
/// (dcm.md T9.3), as the step's own matrix has them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/contact/contact_layer.h"
#include "coupling/mechanics/scene.h"
#include "tests/coupling/exact_steps.h"
#include "tests/coupling/friction_sums.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

// dcm.md §8, w = 0.2, R0 = 6 µm: cos θ = 0.8, R/R0 = 1.00951, d/R0 = 0.80761, a/R0 = 0.60571.
constexpr double kRadius = 1.00951 * 6.0, kFlat = 0.80761 * 6.0, kContactRadius = 0.60571 * 6.0;
constexpr double kMedium = 0.1, kContact = 50.0;  // friction per area [nN·s/µm³]

/// Cells that have no forces of their own.
Model passive_model(double range) {
  Model model = test::clusters_model(0.0);
  dcm::ShellParameters& shell = model.types[0].shell;
  shell.spring_stiffness = shell.tension = shell.hinge_stiffness = shell.bulk_modulus = 0.0;
  shell.shape_stiffness = shell.barrier_stiffness = 0.0;
  shell.medium_friction = model.types[0].medium_friction = kMedium;
  model.pairs = {ContactPair{0.0, kContact, kContact}};
  model.contact.range = range;
  test::solve_exactly(model.step);
  return model;
}

/// A sphere's node as it is in the doublet: those within the rim go to the plane along their radius, those that are nearer to the rim than
/// 0.38 of an edge go to the rim: more would make needles of faces that cross it.
Vec3d flattened(Vec3d p, double edge) {
  p = p * (kRadius / norm(p));
  const double rim = std::acos(kFlat / kRadius), angle = std::acos(p.z / kRadius), across = std::hypot(p.x, p.y);
  if (std::abs(angle - rim) * kRadius < 0.38 * edge) return {p.x / across * kContactRadius, p.y / across * kContactRadius, kFlat};
  return angle < rim ? p * (kFlat / p.z) : p;
}

/// Two spheres that are pressed flat against each other at the plane z = 0, `gap` apart; the upper one is the lower one turned over. An
/// icosphere is its own mirror image, so that faces of the contact lie on faces.
Tissue flat_doublet(const Model& model, ShapeLibrary& shapes, std::uint32_t nodes, double gap) {
  const double edge = kRadius * std::sqrt(8.0 * std::numbers::pi / std::sqrt(3.0) / nodes);  // of equilateral triangles, two by node
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, -6}, {0, 0, 6}}, {BodyKind::kShell, BodyKind::kShell}, nodes);
  for (const std::size_t s : {0u, 1u})
    for (Vec3d& x : tissue.shells.nodes(s)) {
      const double side = s == 0 ? 1.0 : -1.0;
      const Vec3d from_center = x - Vec3d{0.0, 0.0, -6.0 * side};
      Vec3d p = flattened({from_center.x, side * from_center.y, side * from_center.z}, edge);
      p.z -= kFlat + 0.5 * gap;
      x = {p.x, side * p.y, side * p.z};
    }
  tissue.shells.reference_volume = tissue.shells.rest_volume;
  return tissue;
}

ContactScene scene_of(const Mechanics& mechanics) {
  const Scene& scene = mechanics.scene();
  return {scene.bodies(), scene.position(), scene.topologies(), scene.first_face()};
}

/// Velocities under these forces: Γ v = f.
std::vector<Vec3d> velocities(const Model& model, Tissue tissue, ShapeLibrary& shapes, const std::vector<Vec3d>& force) {
  constexpr double kStep = 1e-3;
  const std::vector<Vec3d> start = tissue.shells.position;
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  const auto report = mechanics.step(tissue, kStep, force);
  EXPECT_TRUE(report.ok()) << report.error().what;
  std::vector<Vec3d> out;
  for (std::size_t i = 0; i < start.size(); ++i) out.push_back((tissue.shells.position[i] - start[i]) * (1.0 / kStep));
  return out;
}

double total(const std::vector<double>& values, std::size_t first, std::size_t last) {
  double sum = 0.0;
  for (std::size_t i = first; i < last; ++i) sum += values[i];
  return sum;
}

/// Area of a node in contact, counted from both sides [µm²].
std::vector<double> areas_in_contact(const Mechanics& mechanics, std::size_t nodes) {
  std::vector<double> out(nodes, 0.0);
  for (const test::RubbingPoint& point : test::rubbing_points(mechanics.contacts(), scene_of(mechanics)))
    for (int c = 0; c < 6; ++c) out[point.node[c]] += point.area * std::abs(point.weight[c]);
  return out;
}

/// T9.3: v1 = F/(Γ + 2Γ_c), Γ = γ_ECM A, Γ_c = γ_et A_c. F is shared among the nodes as a rigid cell hands it on, the medium's part by
/// their area and the contact's part by what of them is in contact: nothing turns then, and every node has to move with ±v1.
TEST(ShearedDoublet, MovesWithTheForceOverItsFrictionWithTheMediumAndTwiceThatOfItsContact) {
  Model model = passive_model(0.05);
  ShapeLibrary shapes;
  const Tissue tissue = flat_doublet(model, shapes, 2562, 0.0125);
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  const BodyValues values = mechanics.values(tissue);
  const auto area = test::node_areas(tissue.shells);
  const std::size_t nodes = area.size() / 2;
  const auto in_contact = areas_in_contact(mechanics, area.size());
  const double rubbing = total(in_contact, 0, nodes);
  // A_c = π a² = 41.49 µm², to 3 %: the rim of the mesh is made of edges of 0.45 µm
  EXPECT_NEAR(kContactRadius * kContactRadius * std::numbers::pi, 41.49, 0.01);
  for (const double found : {rubbing, values.contact_area[0], values.contact_area[1]}) EXPECT_NEAR(found, 41.49, 0.03 * 41.49);
  EXPECT_NEAR(total(in_contact, nodes, 2 * nodes), rubbing, 1e-6 * rubbing);

  const double force = 1.0, medium = kMedium * total(area, 0, nodes), contact = kContact * rubbing;
  const double expected = force / (medium + 2.0 * contact);
  EXPECT_NEAR(expected, 2.384e-4, 0.03 * 2.384e-4);
  std::vector<Vec3d> push(area.size());
  Vec3d sum[2];
  for (std::size_t i = 0; i < push.size(); ++i) {
    const std::size_t cell = i < nodes ? 0 : 1;
    push[i].x = (cell == 0 ? -1.0 : 1.0) * expected * (kMedium * area[i] + 2.0 * kContact * in_contact[i]);
    sum[cell] += push[i];
  }
  EXPECT_NEAR(sum[0].x, -force, 1e-5);
  EXPECT_NEAR(sum[1].x, force, 1e-5);
  // Newton's second solve is for what the first has left. Explicit Euler has one solve, to 1e-6 of all forces, of which those on a free
  // node are a thousandth (2γ_ext/γ_ECM = 1000): its velocities hold to a hundredth.
  for (const Integrator integrator : {Integrator::kImplicit, Integrator::kExplicitEuler}) {
    model.step.integrator = integrator;
    const auto v = velocities(model, tissue, shapes, push);
    const double tolerance = integrator == Integrator::kImplicit ? 1e-5 : 1e-2;
    double worst = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i) worst = std::max(worst, norm(v[i] - Vec3d{i < nodes ? -expected : expected, 0.0, 0.0}));
    EXPECT_LT(worst, tolerance * expected);
  }
}

/// T9.3 in cells at rest that adhere, w = W/2γ = 0.2, and can change their shape: what the load adds to their motion. ± 3 % is asked for.
TEST(ShearedDoublet, ThatAdheresMovesWithTheSameSpeed) {
  Model model = test::clusters_model(0.2);
  dcm::ShellParameters& shell = model.types[0].shell;
  shell.medium_friction = model.types[0].medium_friction = kMedium;
  model.contact.range = 0.5;
  test::solve_exactly(model.step);
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, -6}, {0, 0, 6}}, {BodyKind::kShell, BodyKind::kShell});
  ASSERT_LT(test::relax(model, tissue, 1e-4, 50.0), 1e-4);
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  (void)mechanics.values(tissue);
  const auto area = test::node_areas(tissue.shells);
  const std::size_t nodes = area.size() / 2;
  const auto in_contact = areas_in_contact(mechanics, area.size());
  EXPECT_GT(total(in_contact, 0, nodes), 10.0);
  const double expected[2] = {1.0 / (kMedium * total(area, 0, nodes) + 2.0 * kContact * total(in_contact, 0, nodes)),
                              1.0 / (kMedium * total(area, nodes, 2 * nodes) + 2.0 * kContact * total(in_contact, nodes, 2 * nodes))};
  std::vector<Vec3d> push(area.size());
  for (std::size_t i = 0; i < push.size(); ++i) {
    const std::size_t cell = i < nodes ? 0 : 1;
    push[i].x = (cell == 0 ? -1.0 : 1.0) * expected[cell] * (kMedium * area[i] + 2.0 * kContact * in_contact[i]);
  }
  const auto loaded = velocities(model, tissue, shapes, push), free = velocities(model, tissue, shapes, std::vector<Vec3d>(push.size()));
  for (const std::size_t cell : {0u, 1u}) {
    double speed = 0.0, whole = 0.0;
    for (std::size_t i = cell * nodes; i < (cell + 1) * nodes; ++i) speed += area[i] * (loaded[i].x - free[i].x), whole += area[i];
    EXPECT_NEAR(speed / whole / ((cell == 0 ? -1.0 : 1.0) * expected[cell]), 1.0, 1e-3);
  }
}

}  // namespace
}  // namespace morula
