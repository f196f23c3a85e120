// Shells whose nodes have drifted together get an even mesh, and keep what they are.
#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "core/mesh/renewal/own_mesh.h"
#include "core/mesh/renewal/surface_view.h"
#include "coupling/cell_variables.h"
#include "coupling/new_mesh.h"
#include "coupling/simulation.h"
#include "tests/coupling/crowded_nodes.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

/// A fluid cortex that nothing holds but its tension.
Model fluid_model(double below) {
  Model model = test::clusters_model();
  CellType& type = model.types[0];
  type.shell.spring_stiffness = type.shell.hinge_stiffness = type.shell.shape_stiffness = 0.0;
  type.renew_mesh_below = below;
  model.step.initial_step = 1e-3;  // mechanics does nothing that matters
  model.step.max_step = 1e-3;
  return model;
}

class MeshRenewalTest : public ::testing::Test {
 protected:
  /// Two cells in contact, the first with crowded nodes, after the step at which meshes are looked at.
  std::unique_ptr<Simulation> after_a_look(const Model& model, const std::function<void(Tissue&)>& change) {
    using enum BodyKind;
    Tissue tissue = test::make_tissue(model, shapes_, {{-5.9, 0, 0}, {5.9, 0, 0}}, {kShell, kShell});
    change(tissue);
    tissue.clock.steps = 4;
    auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1);
    EXPECT_TRUE(simulation.ok());
    const auto done = (*simulation)->step(1e6);
    EXPECT_TRUE(done.ok()) << done.error().message;
    if (done.ok()) events_ = done->events;
    return std::move(simulation).value();
  }
  static double told(const Simulation& simulation, std::size_t cell, MeshRenewal what) {
    return simulation.tissue().cells.state(cell).variable(mesh_renewal_variable(simulation.model(), what));
  }
  static double quality(const Tissue& tissue, std::size_t shell) {
    return least_quality(tissue.shells.topology(shell).faces(), tissue.shells.nodes(shell));
  }

  static double told(const Simulation& simulation, std::size_t cell, OwnMeshRenewal what) {
    return simulation.tissue().cells.state(cell).variable(own_mesh_variable(simulation.model(), what));
  }
  static double area_of_mark(const Tissue& tissue) {
    double sum = 0.0;
    const auto faces = tissue.shells.topology(0).faces();
    const auto x = tissue.shells.nodes(0);
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (tissue.shells.marks_of(0).has(f, 0)) sum += 0.5 * norm(cross(x[faces[f][1]] - x[faces[f][0]], x[faces[f][2]] - x[faces[f][0]]));
    return sum;
  }

  ShapeLibrary shapes_;
  std::vector<Event> events_;
};

/// Draws a ball out along z to a rod of the same volume.
void draw_out(std::span<Vec3d> nodes, double stretch) {
  const Vec3d center = mean_of(std::span<const Vec3d>(nodes));
  for (Vec3d& x : nodes) {
    const Vec3d d = x - center;
    x = center + Vec3d{d.x / std::sqrt(stretch), d.y / std::sqrt(stretch), d.z * stretch};
  }
}

TEST_F(MeshRenewalTest, SpreadsCrowdedNodesOnTheSameSurface) {
  double before = 0.0, volume = 0.0;
  const auto simulation = after_a_look(fluid_model(0.4), [&](Tissue& tissue) {
    test::crowd(tissue.shells.nodes(0), 0.42);
    before = quality(tissue, 0);
    volume = enclosed_volume(tissue.shells.topology(0).faces(), tissue.shells.nodes(0), {});
  });
  const Tissue& tissue = simulation->tissue();
  EXPECT_LT(before, 0.4);
  EXPECT_GT(quality(tissue, 0), 0.6);
  EXPECT_NEAR(enclosed_volume(tissue.shells.topology(0).faces(), tissue.shells.nodes(0), {}) / volume, 1.0, 1e-3)
      << "but for the step, in which pressure acts";
  EXPECT_EQ(told(*simulation, 0, MeshRenewal::kDone), 1.0);
  EXPECT_EQ(told(*simulation, 0, MeshRenewal::kRefused), 0.0);
  EXPECT_LT(told(*simulation, 0, MeshRenewal::kDistance), 0.25);
  EXPECT_EQ(told(*simulation, 1, MeshRenewal::kDone), 0.0) << "the other one is even";
  EXPECT_TRUE(events_.empty());
}

TEST_F(MeshRenewalTest, IsLeftAloneWhereTheTypeDoesNotAskForIt) {
  double before = 0.0;
  const auto simulation = after_a_look(fluid_model(0.0), [&](Tissue& tissue) {
    test::crowd(tissue.shells.nodes(0), 0.42);
    before = quality(tissue, 0);
  });
  EXPECT_NEAR(quality(simulation->tissue(), 0), before, 0.05);
  EXPECT_TRUE(cell_variables(simulation->model()).empty());
}

TEST_F(MeshRenewalTest, TellsOnceWhatItCannotDoAndTriesLater) {
  const auto simulation = after_a_look(fluid_model(0.4), [&](Tissue& tissue) {
    const std::span<Vec3d> nodes = tissue.shells.nodes(0);  // a spike that no even mesh of this many nodes follows
    nodes[7] += (nodes[7] - mean_of(std::span<const Vec3d>(nodes))) * 2.0;
  });
  ASSERT_EQ(events_.size(), 1u);
  EXPECT_EQ(events_[0].reason.cause, EventReason::Cause::kUnevenMesh);
  EXPECT_EQ(events_[0].cell, CellId::founder(1));
  EXPECT_EQ(told(*simulation, 0, MeshRenewal::kDone), 0.0);
  EXPECT_EQ(told(*simulation, 0, MeshRenewal::kRefused), 1.0);
  EXPECT_GT(told(*simulation, 0, MeshRenewal::kNextTry), 599.0);
}

TEST_F(MeshRenewalTest, CarriesMarksContactAndNucleus) {
  Model model = fluid_model(0.4);
  model.types[0].interior.nucleus_fraction = 0.1;
  double marked = 0.0;
  const auto simulation = after_a_look(model, [&](Tissue& tissue) {
    test::crowd(tissue.shells.nodes(0), 0.42);
    const auto faces = tissue.shells.topology(0).faces();
    dcm::FaceState& state = tissue.shells.faces_of(0);
    state.mark.assign(faces.size(), 0);
    state.contact.assign(faces.size(), 0.25f);
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (tissue.shells.nodes(0)[faces[f][0]].z > 2.0) state.mark[f] = 1;
    tissue.shells.nucleus[0] = Vec3d{-5.0, 0.5, 0.0};
    marked = area_of_mark(tissue);
  });
  const Tissue& tissue = simulation->tissue();
  EXPECT_EQ(told(*simulation, 0, MeshRenewal::kDone), 1.0);
  EXPECT_NEAR(area_of_mark(tissue) / marked, 1.0, 0.01);
  for (const float contact : tissue.shells.faces_of(0).contact) EXPECT_EQ(contact, 0.25f);
  ASSERT_NE(tissue.shells.nucleus_of(0), nullptr);
  EXPECT_LT(norm(*tissue.shells.nucleus_of(0) - Vec3d{-5.0, 0.5, 0.0}), 1e-3);
}

/// An elastic surface stretched evenly is stretched evenly on the new mesh, too.
TEST_F(MeshRenewalTest, CarriesTheMetricOfAStretchedSurface) {
  Model model = fluid_model(0.4);
  model.types[0].shell.spring_stiffness = 0.173;
  const auto simulation = after_a_look(model, [&](Tissue& tissue) {
    test::crowd(tissue.shells.nodes(0), 0.42);
    const auto x = tissue.shells.nodes(0);
    const auto edges = tissue.shells.topology(0).edges();
    for (std::size_t e = 0; e < edges.size(); ++e) tissue.shells.rest_length[e] = norm(x[edges[e].j] - x[edges[e].i]) / 1.1;
  });
  const Tissue& tissue = simulation->tissue();
  EXPECT_EQ(told(*simulation, 0, MeshRenewal::kDone), 1.0);
  const auto x = tissue.shells.nodes(0);
  const auto edges = tissue.shells.topology(0).edges();
  double least = 2.0, most = 0.0, sum = 0.0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const double stretch = norm(x[edges[e].j] - x[edges[e].i]) / tissue.shells.rest_length[e];
    least = std::min(least, stretch), most = std::max(most, stretch), sum += stretch;
  }
  EXPECT_NEAR(sum / static_cast<double>(edges.size()), 1.1, 0.002) << "2 % of the tension";
  EXPECT_GT(least, 1.08);
  EXPECT_LT(most, 1.12);
}

/// Marks, contact, nucleus and the metric of an elastic surface that is stretched evenly by a tenth go over to another connectivity.
TEST_F(MeshRenewalTest, GivesARodAMeshOfItsOwnThatHasWhatTheOldOneHad) {
  Model model = fluid_model(0.5);
  CellType& type = model.types[0];
  type.own_mesh = true;
  type.shell.spring_stiffness = 0.173;
  type.interior.nucleus_fraction = 0.1;
  double marked = 0.0, volume = 0.0, before = 0.0;
  const auto simulation = after_a_look(model, [&](Tissue& tissue) {
    const auto x = tissue.shells.nodes(0);
    draw_out(x, 3.0);
    const auto faces = tissue.shells.topology(0).faces();
    dcm::FaceState& state = tissue.shells.faces_of(0);
    state.mark.assign(faces.size(), 0);
    state.contact.assign(faces.size(), 0.25f);
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (x[faces[f][0]].z > 0.0) state.mark[f] = 1;
    tissue.shells.nucleus[0] = Vec3d{-5.9, 0.2, 0.0};
    marked = area_of_mark(tissue), before = quality(tissue, 0);
    volume = enclosed_volume(faces, x, {});
    const auto edges = tissue.shells.topology(0).edges();
    for (std::size_t e = 0; e < edges.size(); ++e) tissue.shells.rest_length[e] = norm(x[edges[e].j] - x[edges[e].i]) / 1.1;
  });
  const Tissue& tissue = simulation->tissue();
  EXPECT_EQ(told(*simulation, 0, OwnMeshRenewal::kPasses), 1.0);
  EXPECT_EQ(told(*simulation, 0, MeshRenewal::kDone), 0.0) << "longer than the library's connectivity bears";
  EXPECT_GT(told(*simulation, 0, OwnMeshRenewal::kChanges), 20.0);
  EXPECT_LE(told(*simulation, 0, OwnMeshRenewal::kArea), 1.01e-4);
  EXPECT_LE(told(*simulation, 0, OwnMeshRenewal::kVolume), 1e-12);
  EXPECT_EQ(tissue.shells.shape[0]->icosphere_nodes, 0u);
  EXPECT_NE(tissue.shells.topology(0).node_count(), 162u);
  EXPECT_EQ(tissue.shells.shape[1]->icosphere_nodes, 162u) << "the other one is a ball";
  EXPECT_NEAR(enclosed_volume(tissue.shells.topology(0).faces(), tissue.shells.nodes(0), {}) / volume, 1.0, 1e-3) << "but for the step";
  EXPECT_NEAR(area_of_mark(tissue) / marked, 1.0, 0.01);
  for (const float contact : tissue.shells.faces_of(0).contact) EXPECT_EQ(contact, 0.25f);
  ASSERT_NE(tissue.shells.nucleus_of(0), nullptr);
  EXPECT_LT(norm(*tissue.shells.nucleus_of(0) - Vec3d{-5.9, 0.2, 0.0}), 0.1);
  const auto x = tissue.shells.nodes(0);
  const auto edges = tissue.shells.topology(0).edges();
  double sum = 0.0, least = 2.0, most = 0.0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const double stretch = norm(x[edges[e].j] - x[edges[e].i]) / tissue.shells.rest_length[e];
    sum += stretch, least = std::min(least, stretch), most = std::max(most, stretch);
  }
  EXPECT_NEAR(sum / static_cast<double>(edges.size()), 1.1, 0.002) << "2 % of the tension";
  EXPECT_GT(least, 1.05);
  EXPECT_LT(most, 1.15);
}

/// The stress-free shape of a ball on another connectivity is that ball: its areas, and the curvature that its rest angles stand for.
TEST_F(MeshRenewalTest, AMeshOfItsOwnRemembersTheBallThatItWas) {
  Model model = fluid_model(0.5);
  model.types[0].own_mesh = true;
  model.types[0].shell.spring_stiffness = 0.173;
  const auto simulation = after_a_look(model, [&](Tissue& tissue) { draw_out(tissue.shells.nodes(0), 3.0); });
  const ReferenceShape& own = *simulation->tissue().shells.shape[0];
  ASSERT_EQ(own.icosphere_nodes, 0u);
  const ReferenceShape& ball = *simulation->tissue().shells.shape[1];
  const auto sum = [](const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); };
  EXPECT_NEAR(sum(own.face_area) / sum(ball.face_area), 1.0, 1e-12);
  // ∫H dA = ½ Σ l θ of the surface is 4πR of a ball, here of volume one.
  const auto mean_curvature_of = [](const ReferenceShape& shape) {
    double out = 0.0;
    for (std::size_t e = 0; e < shape.edge_length.size(); ++e) out += 0.5 * shape.edge_length[e] * shape.hinge_angle[e];
    return out;
  };
  EXPECT_NEAR(mean_curvature_of(ball), 4.0 * std::numbers::pi * std::cbrt(3.0 / (4.0 * std::numbers::pi)), 0.2);
  EXPECT_NEAR(mean_curvature_of(own) / mean_curvature_of(ball), 1.0, 0.02);
}

TEST_F(MeshRenewalTest, GoesBackToTheMeshOfTheLibraryWhenItHasRoundedUp) {
  Model model = fluid_model(0.4);
  model.types[0].own_mesh = true;
  double volume = 0.0;
  const auto simulation = after_a_look(model, [&](Tissue& tissue) {
    // A rod with a mesh of its own that has become a ball: the first shell is made anew with it.
    std::vector<CellRecord> cells = take_apart(tissue);
    dcm::ShellRecord& shell = *cells[0].shell;
    draw_out(shell.position, 2.0);
    OwnMesh own = renew_connectivity({shell.position, shell.shape->topology.get()}, {}, {.nodes = 162}).value();
    draw_out(own.position, 0.5);
    const AskedSurface surface(SurfaceView{shell.position, shell.shape->topology.get()});
    shell.shape = carried_shape(shell, surface, own.topology, own.position, false);
    shell.position = own.position;
    shell.velocity.assign(own.position.size(), Vec3f{});
    shell.rest_length = free_rest_lengths(*shell.shape, shell.rest_volume);
    volume = enclosed_volume(own.topology->faces(), own.position, {});
    put_together(tissue, std::move(cells));
  });
  const Tissue& tissue = simulation->tissue();
  EXPECT_EQ(told(*simulation, 0, OwnMeshRenewal::kReturns), 1.0);
  EXPECT_EQ(tissue.shells.shape[0]->icosphere_nodes, 162u);
  EXPECT_GT(quality(tissue, 0), 0.55);
  EXPECT_NEAR(enclosed_volume(tissue.shells.topology(0).faces(), tissue.shells.nodes(0), {}) / volume, 1.0, 1e-3) << "but for the step";
}

}  // namespace
}  // namespace morula
