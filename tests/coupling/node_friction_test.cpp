#include "coupling/mechanics/node_friction.h"

#include <gtest/gtest.h>

#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

SurfaceGeometry geometry_of(const Tissue& tissue) {
  std::vector<const Topology*> topology;
  std::vector<std::uint32_t> first_face{0};
  for (std::size_t s = 0; s < tissue.shells.size(); ++s) {
    topology.push_back(&tissue.shells.topology(s));
    first_face.push_back(first_face.back() + topology.back()->face_count());
  }
  SurfaceGeometry out;
  compute_surface_geometry({topology, tissue.shells.first_node, first_face}, tissue.shells.position, out);
  return out;
}

/// A rigid sphere feels (γ_n + 2γ_t)/3 of its area, and one that breathes γ_n.
TEST(NodeFriction, FrictionAcrossAndAlongAddsUpToTheDragOfASphere) {
  for (const auto& [across, along] : {std::pair{0.3, 0.06}, {0.06, 0.3}}) {
    Model model = test::clusters_model();
    CellType& type = model.types[0];
    type.shell.medium_friction = std::min(across, along);
    type.medium_normal_extra = std::max(0.0, across - along);
    type.medium_tangent_extra = std::max(0.0, along - across);
    ShapeLibrary shapes;
    const Tissue tissue = test::make_tissue(model, shapes, {{4, 5, 6}}, {BodyKind::kShell}, 642);
    const SurfaceGeometry geometry = geometry_of(tissue);
    const auto blocks = NodeFriction(model).at(tissue, geometry);
    ASSERT_EQ(blocks.size(), 642u);
    const Vec3d v = normalized(Vec3d{1, -2, 0.5});
    double drag = 0.0, breathing = 0.0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const double base = type.shell.medium_friction * geometry.node_area[i];
      drag += base + dot(v, blocks[i] * v);
      breathing += base + dot(geometry.node_normal[i], blocks[i] * geometry.node_normal[i]);
    }
    EXPECT_NEAR(drag / geometry.area[0], (across + 2.0 * along) / 3.0, 1e-10);  // Σ a n nᵀ = A/3 by the symmetry of the icosahedron
    EXPECT_NEAR(breathing / geometry.area[0], across, 1e-12);
  }
}

/// T9.2 with a tensor: V = F/(A (γ_n + 2γ_t)/3).
TEST(NodeFriction, AForceMovesACellByTheMeanOfItsFriction) {
  Model model = test::clusters_model();
  CellType& type = model.types[0];
  type.shell.spring_stiffness = 50.0;  // a stiff cell: it does not flatten before its own drag
  type.shell.bulk_modulus = 200.0;
  type.shell.medium_friction = 0.05;
  type.medium_normal_extra = 0.25;
  model.step.first_tolerance = model.step.later_tolerance = 1e-6;
  model.step.newton_stop = 1e-4;
  model.step.max_newton = 10;
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 162);
  CellLoad load;
  load.force = {0.06, 0, 0.08};
  model.loads = {load};
  auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
  while (simulation->tissue().clock.time < 40.0) ASSERT_TRUE(simulation->step(40.0).ok());
  const Vec3d from = simulation->centers()[0];
  const double start = simulation->tissue().clock.time;
  while (simulation->tissue().clock.time < 80.0) ASSERT_TRUE(simulation->step(80.0).ok());
  const double speed = norm(simulation->centers()[0] - from) / (simulation->tissue().clock.time - start);
  const double expected = 0.1 / (simulation->values().area[0] * (0.3 + 2.0 * 0.05) / 3.0);
  EXPECT_NEAR(speed / expected, 1.0, 0.02);
}

}  // namespace
}  // namespace morula
