// A nucleus that is a shell of its own: its forces, its friction, and what it does in the implicit step.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "core/mesh/mesh_check.h"
#include "core/mesh/primitives.h"
#include "core/random/philox.h"
#include "coupling/swaps.h"
#include "dcm/derived_parameters.h"
#include "tests/coupling/energy_gradient.h"
#include "tests/coupling/one_cell_fixture.h"

namespace morula {
namespace {

using namespace test;

/// A nucleus of this radius, with springs and hinges of a lamina of Young's modulus `young` [kPa], 0.2 µm thick.
void give_nuclear_shell(Model& model, double radius, double young, std::uint32_t nodes = 162) {
  dcm::InteriorParameters& p = model.types[0].interior;
  p.nucleus_fraction = fraction(radius);
  p.nucleus_nodes = nodes;
  p.nucleus_shell = {};
  constexpr double thickness = 0.2;
  p.nucleus_shell.spring_stiffness = dcm::spring_stiffness(young, thickness);
  p.nucleus_shell.hinge_stiffness = dcm::hinge_stiffness(dcm::bending_modulus(young, thickness, 0.5));
  p.nucleus_shell.bulk_modulus = 10.0;
  p.nucleus_shell.shape_stiffness = 0.3;
}

double extent(std::span<const Vec3d> nodes, std::size_t axis) {
  double low = 1e300, high = -1e300;
  for (const Vec3d& x : nodes) low = std::min(low, x[axis]), high = std::max(high, x[axis]);
  return high - low;
}

/// Smallest distance of a node of the nucleus from the cortex, < 0 outside.
double clearance(const Tissue& tissue) {
  dcm::NucleusView view;
  view.cell_topology = &tissue.shells.topology(0);
  view.cell = tissue.shells.position;
  view.nucleus = tissue.nuclei.shells.position;
  return dcm::nucleus_clearance(view);
}

/// Winding number of the cell around the centre of its nucleus.
double winding(const Tissue& tissue) {
  return winding_number(tissue.shells.position, tissue.shells.topology(0).faces(), mean(tissue.nuclei.shells.position));
}

/// A cell and a nucleus, both dented at random, that press against each other on one side; linked, under tension.
Tissue pressed(Model& model) {
  model = clusters_model(0.0);
  give_nuclear_shell(model, 4.0, 5.0);
  model.types[0].interior.nucleus_shell.tension = 0.1;
  model.types[0].interior.nucleus_links = {40, 0.02, 0.1, false};
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  const Random random(3, RandomStream::kInitialPosition);
  std::uint64_t draw = 0;
  for (Vec3d& x : tissue.shells.position) x += random.direction(CellId(1), draw++) * 0.05;
  for (Vec3d& x : tissue.nuclei.shells.position) x += random.direction(CellId(1), draw++) * 0.05 + Vec3d{1.7, 1.2, 0.4};
  return tissue;
}

TEST(NuclearShell, ForceIsMinusTheGradientOfTheEnergy) {
  Model model;
  const Tissue tissue = pressed(model);
  ShapeLibrary shapes;
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  std::vector<Vec3d> force, unused;
  (void)mechanics.energy_and_forces(tissue, force);
  ASSERT_GT(mechanics.nucleus_of(0)->overlap, 0.05) << "or there is no contact to test";
  const auto on_nucleus = mechanics.forces_on_nuclei();
  force.insert(force.end(), on_nucleus.begin(), on_nucleus.end());
  expect_minus_gradient(tissue, force, 12, 1e-7, [&](const Tissue& moved) {
    Mechanics other(model, {}, shapes, Comm(), 1);
    return other.energy_and_forces(moved, unused);
  });
}

TEST(NuclearShell, HasNoNetForceOrTorqueWithItsCell) {  // T12.2
  Model model;
  const Tissue tissue = pressed(model);
  ShapeLibrary shapes;
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  std::vector<Vec3d> force;
  (void)mechanics.energy_and_forces(tissue, force);
  Vec3d sum, torque;
  double all = 0.0;
  const auto add = [&](const Vec3d& f, const Vec3d& x) {
    sum += f;
    torque += cross(x, f);
    all += norm(f);
  };
  for (std::size_t i = 0; i < force.size(); ++i) add(force[i], tissue.shells.position[i]);
  const auto on_nucleus = mechanics.forces_on_nuclei();
  double one = 0.0;
  for (std::size_t i = 0; i < on_nucleus.size(); ++i) {
    add(on_nucleus[i], tissue.nuclei.shells.position[i]);
    one += on_nucleus[i].x;
  }
  EXPECT_LT(norm(sum), 1e-12 * all);
  EXPECT_LT(norm(torque), 1e-12 * all * kRadius);
  EXPECT_GT(std::abs(one), 0.05) << "each of the two does have one";
}

TEST(NuclearShell, RestsInACellAtRest) {
  Model model = clusters_model(0.0);
  give_nuclear_shell(model, 2.5, 5.0);
  model.types[0].interior.nucleus_shell.tension = 0.2;
  const auto simulation = one_cell(model);
  run(*simulation, 600.0);
  const NucleusState state = *simulation->mechanics().nucleus_of(0);
  EXPECT_NEAR(state.volume / (4.0 / 3.0 * std::numbers::pi * 2.5 * 2.5 * 2.5), 1.0, 2e-3);
  // Laplace for both: 2γ_n/R_n over the pressure of the cytosol, 2γ/R; meshes of 162 nodes are within 2 % of a sphere's curvature
  const double cytosol = simulation->values().inner_pressure[0];
  EXPECT_NEAR(cytosol, 2.0 * 0.5 / kRadius, 0.02 * 2.0 * 0.5 / kRadius);
  EXPECT_NEAR(state.pressure - cytosol, 2.0 * 0.2 / 2.5, 0.03 * 2.0 * 0.2 / 2.5);
  EXPECT_LT(norm(mean(simulation->tissue().nuclei.shells.position)), 1e-3);
}

/// Friction of a nucleus in its cell for given motions: dᵀΓd, and what the two feel.
struct Rubbing {
  dcm::InteriorParameters parameters;
  std::vector<Vec3d> cell, nucleus, cell_force, nucleus_force;
  double quadratic = 0.0;

  template <class Motion, class NucleusMotion>
  Rubbing(bool linked, Motion&& of_cell, NucleusMotion&& of_nucleus) {
    Model model;
    const Tissue tissue = pressed(model);
    parameters = model.types[0].interior;
    parameters.cytoplasm_viscosity = 1e-2;
    dcm::NucleusView view;
    view.parameters = &parameters;
    view.cell_topology = &tissue.shells.topology(0);
    view.nucleus_topology = &tissue.nuclei.shells.topology(0);
    cell = tissue.shells.position, nucleus = tissue.nuclei.shells.position;
    view.cell = cell, view.nucleus = nucleus;
    view.rest_volume = kVolume;
    if (!linked) parameters.nucleus_links = {};
    const auto links = dcm::choose_nuclear_links(*tissue.shells.shape[0], *tissue.nuclei.shells.shape[0], parameters);
    EXPECT_EQ(links.size(), linked ? 40u : 0u);
    view.links = links;
    const auto areas = [](const Topology& topology, std::span<const Vec3d> x) {
      std::vector<double> out(x.size());
      for (const Triangle& t : topology.faces())
        for (const std::uint32_t i : t) out[i] += norm(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])) / 6.0;
      return out;
    };
    dcm::NuclearFriction friction;
    dcm::find_nuclear_friction(view, areas(*view.cell_topology, cell), areas(*view.nucleus_topology, nucleus), friction);
    std::vector<Vec3d> cell_way, nucleus_way;
    for (const Vec3d& x : cell) cell_way.push_back(of_cell(x));
    for (const Vec3d& x : nucleus) nucleus_way.push_back(of_nucleus(x));
    cell_force.resize(cell.size()), nucleus_force.resize(nucleus.size());
    quadratic = dcm::add_nuclear_friction(view, friction, {cell_way, nucleus_way}, {cell_force, nucleus_force});
  }
};

TEST(NuclearFriction, FeelsNoRigidMotionAndDragsAsStokesHasIt) {
  const Vec3d spin{0.3, -0.2, 0.5}, shift{1, 2, 3};
  const auto rigid = [&](const Vec3d& x) { return shift + cross(spin, x - Vec3d{2, 0, 1}); };
  const Rubbing together(true, rigid, rigid);
  EXPECT_LT(together.quadratic, 1e-20);
  for (const Vec3d& f : together.nucleus_force) EXPECT_LT(norm(f), 1e-12);

  const auto still = [](const Vec3d&) { return Vec3d{}; };
  const auto along = [](const Vec3d&) { return Vec3d{0, 0, 1}; };
  const Rubbing sinking(false, still, along), linked(true, still, along);
  Vec3d on_nucleus, on_cell, torque;
  for (std::size_t i = 0; i < sinking.nucleus.size(); ++i) {
    on_nucleus += sinking.nucleus_force[i];
    torque += cross(sinking.nucleus[i], sinking.nucleus_force[i]);
  }
  for (std::size_t i = 0; i < sinking.cell.size(); ++i) {
    on_cell += sinking.cell_force[i];
    torque += cross(sinking.cell[i], sinking.cell_force[i]);
  }
  EXPECT_NEAR(on_nucleus.z, 6.0 * std::numbers::pi * 1e-2 * 4.0, 1e-12) << "6πηR_n v, η = 1e-2 kPa s and R_n = 4 µm";
  EXPECT_LT(norm(on_nucleus + on_cell), 1e-12);
  EXPECT_LT(norm(torque), 1e-11);
  EXPECT_NEAR(sinking.quadratic, on_nucleus.z, 1e-12);
  EXPECT_GT(linked.quadratic, sinking.quadratic + 0.5)
      << "40 dampers of 0.1 nN s/µm, in all directions: at most 4, a third of that on average";
  EXPECT_LT(linked.quadratic, sinking.quadratic + 4.0);
}

Model stretched_model() {  // S1: T 3e-5 N/m, 1 Pa
  Model model = clusters_model(0.0);
  model.types[0].shell.tension = 0.03;
  CellLoad load;
  load.what = traction_load();
  load.size = 1e-3;
  model.loads = {load};
  model.step.max_step = 5.0;
  return model;
}

double axial_strain(const Model& model, double time) {
  const auto simulation = one_cell(model);
  run(*simulation, time);
  ShapeLibrary shapes;
  const Tissue before = make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  return extent(simulation->tissue().shells.position, 0) / extent(before.shells.position, 0) - 1.0;
}

TEST(FloatingNuclearShell, ChangesTheStretcherByLessThanOnePercent) {  // S1.6
  Model model = stretched_model();
  const double without = axial_strain(model, 150.0);
  give_nuclear_shell(model, 2.5, 5.0, 42);
  EXPECT_GT(without, 0.003);
  EXPECT_NEAR(axial_strain(model, 150.0) / without, 1.0, 0.01);
  model.types[0].interior.nucleus_links = {dcm::LinkParameters::kAll, 0.03, 0.0, false};
  EXPECT_LT(axial_strain(model, 150.0), 0.97 * without) << "links to its nodes stiffen the cell: O7.1";
}

TEST(FloatingNuclearShell, GoesWithItsCell) {
  Model model = clusters_model(0.0);
  CellLoad load;
  load.force = {0.9, 0, 0};
  model.loads = {load};
  model.step.max_step = 10.0;
  give_nuclear_shell(model, 2.5, 5.0, 42);
  const auto simulation = one_cell(model);
  run(*simulation, 200.0);
  const Vec3d cell = mean(simulation->tissue().shells.position);
  EXPECT_GT(cell.x, 3.5) << "T9.2: 0.0221 µm/s per nN";
  EXPECT_LT(norm(mean(simulation->tissue().nuclei.shells.position) - cell), 0.1)
      << "it starts a step after the cell, and floats: nothing brings it back";
}

/// A cell between two plates that come as near as 8 µm: gap, force, and the shape of the nucleus.
struct Squeeze {
  std::vector<double> gap, force;
  double overlap = 0.0, clearance = 1e300, winding = 1.0, aspect = 1.0;
  double at(double wanted) const {
    for (std::size_t k = 1; k < gap.size(); ++k)
      if (gap[k] <= wanted) return force[k] + (force[k - 1] - force[k]) * (wanted - gap[k]) / (gap[k - 1] - gap[k]);
    return std::numeric_limits<double>::quiet_NaN();
  }
};

Squeeze squeeze(Model model) {
  model.contact.range = 0.5;
  model.contact.repulsion = 100.0;
  model.contact.points_per_face = 3;
  TriangleMesh lower = make_box({40, 40, 4}, 10.0).value(), upper = lower;
  for (Vec3d& x : lower.position) x.z -= 8.2;
  for (Vec3d& x : upper.position) x.z += 8.2;
  const double speed = 0.02;
  model.obstacles = {{"lower", lower.position, lower.faces, false, {0, 0, 0.5 * speed}, {}, {}},
                     {"upper", upper.position, upper.faces, false, {0, 0, -0.5 * speed}, {}, {}}};
  model.pairs.assign(9, ContactPair{0.0, 0.1, 0.1});
  model.step.max_step = 2.0;
  model.step.max_newton = 5;
  model.step.newton_stop = 0.01;  // the plates bear the residual
  const auto simulation = one_cell(model);
  Squeeze out;
  while (out.gap.empty() || out.gap.back() > 8.0) {
    const auto step = simulation->step(1e6);
    if (!step.ok()) {
      ADD_FAILURE() << step.error().message;
      break;
    }
    const auto force = simulation->mechanics().obstacle_forces(simulation->tissue());
    out.gap.push_back(12.4 - speed * simulation->tissue().clock.time);
    out.force.push_back(0.5 * (force[1].z - force[0].z));
    const auto nucleus = simulation->mechanics().nucleus_of(0);
    if (!nucleus) continue;
    out.overlap = std::max(out.overlap, nucleus->overlap);
    out.clearance = std::min(out.clearance, clearance(simulation->tissue()));
    out.winding = std::min(out.winding, winding(simulation->tissue()));
  }
  const auto& nodes = simulation->tissue().nuclei.shells.position;
  if (!nodes.empty()) out.aspect = extent(nodes, 0) / extent(nodes, 2);
  return out;
}

TEST(SqueezedNuclearShell, PushesBackAsARigidOneAndFlattensWhenSoft) {  // T12.3, T12.4
  Model model = clusters_model(0.0);
  model.types[0].shell.shape_stiffness = 0.3;  // the cortex stays as stiff as the forces below were chosen for
  const Squeeze bare = squeeze(model);
  model.types[0].interior.nucleus_fraction = fraction(4.2);
  const Squeeze rigid = squeeze(model);
  give_nuclear_shell(model, 4.2, 5.0);
  dcm::ShellParameters& p = model.types[0].interior.nucleus_shell;
  p.spring_stiffness = 1000.0, p.helfrich_rigidity = 100.0, p.spontaneous_curvature = 2.0 / 4.2, p.bulk_modulus = 500.0;
  const Squeeze stiff = squeeze(model);
  p.helfrich_rigidity = 0.0, p.hinge_stiffness = 100.0;
  const Squeeze hinged = squeeze(model);
  give_nuclear_shell(model, 4.2, 5.0);
  const Squeeze soft = squeeze(model);
  give_nuclear_shell(model, 4.2, 1000.0);
  p.bulk_modulus = 100.0;
  const Squeeze between = squeeze(model);
  for (const double gap : {11.0, 9.5, 8.75}) EXPECT_NEAR(stiff.at(gap) / bare.at(gap), 1.0, 0.04) << "nothing touches above 2 R_n = 8.4 µm";
  const double jump = rigid.at(8.05) - bare.at(8.05);
  EXPECT_GT(jump, 2.0 * bare.at(8.05)) << "below it the nucleus pushes";
  EXPECT_NEAR((stiff.at(8.05) - bare.at(8.05)) / jump, 1.0, 0.25);
  EXPECT_NEAR((hinged.at(8.05) - bare.at(8.05)) / jump, 1.0, 0.25);
  EXPECT_LT(hinged.gap.size(), 2 * stiff.gap.size()) << "stiff hinges take the steps of all others";
  EXPECT_LT(soft.at(8.05) - bare.at(8.05), 0.5 * jump);
  EXPECT_GT(between.at(8.05) - bare.at(8.05), 0.1 * jump)
      << "the soft one adds 2 % to the force of the cell, less than that scatters by with the steps";
  EXPECT_LT(between.at(8.05) - bare.at(8.05), 0.9 * jump);
  EXPECT_GT(soft.aspect, stiff.aspect + 0.01);
  EXPECT_GT(stiff.aspect, 0.99);
  for (const Squeeze& one : {stiff, hinged, soft}) {
    EXPECT_GT(one.overlap, 0.0);
    EXPECT_LT(one.overlap, 0.1);
    EXPECT_NEAR(one.winding, 1.0, 1e-9) << "its centre is never outside";
    EXPECT_GT(one.clearance, -0.15) << "nodes may dip in between the points of contact";
  }
}

TEST(NuclearShell, ComesWithAPromotionTravelsInARecordAndGoesWithADemotion) {
  Model model = clusters_model();
  give_nuclear_shell(model, 2.5, 5.0, 42);
  const CellType& type = model.types[0];
  CellState row;
  row.id = CellId::founder(1);
  row.target_volume = kVolume;
  CellRecord cell{row, SphereRecord{{1, 2, 3}, kRadius, {0.5f, 0, 0}, {}}, std::nullopt};
  ShapeLibrary shapes;
  promote(cell, type, 0.0, 0.0, shapes, 1);
  ASSERT_TRUE(cell.shell->nuclear_shell);
  EXPECT_FALSE(cell.shell->nucleus) << "there is no rigid one";
  EXPECT_LT(norm(mean(cell.shell->nuclear_shell->position) - Vec3d{1, 2, 3}), 1e-9);
  EXPECT_NEAR(cell.shell->nuclear_shell->rest_volume, 4.0 / 3.0 * std::numbers::pi * 2.5 * 2.5 * 2.5, 1e-9);
  cell.shell->nuclear_shell->position[7] += Vec3d{0.1, 0, 0};
  std::vector<std::byte> bytes;
  append_bytes(cell, bytes);
  Tissue tissue;
  put_together(tissue, read_records(bytes, shapes));
  ASSERT_EQ(tissue.nuclei.size(), 1u);
  EXPECT_EQ(tissue.shells.size(), 1u);
  EXPECT_EQ(tissue.shells.node_count(), 162u) << "a nucleus is in no count of the cells' nodes";
  EXPECT_EQ(tissue.nuclei.shells.position, cell.shell->nuclear_shell->position);
  EXPECT_EQ(tissue.nuclei.shells.velocity, cell.shell->nuclear_shell->velocity);
  std::vector<std::byte> again;
  append_bytes(take_apart(tissue)[0], again);
  EXPECT_EQ(again, bytes);
  EXPECT_EQ(tissue.nuclei.size(), 0u);
  demote(cell, type, 1.0);
  EXPECT_FALSE(cell.shell);
}

TEST(NuclearShell, GrowsWithItsCell) {
  Model model = clusters_model();
  give_nuclear_shell(model, 2.5, 5.0, 42);
  model.types[0].cycles = true;
  model.types[0].cycle_duration = {1200.0, 0.0};
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  tissue.cells.rows[0].cycle_duration = 1200.0;
  const auto simulation = std::move(Simulation::create(model, std::move(tissue), Comm(), 1)).value();
  run(*simulation, 600.0);
  const double target = simulation->tissue().cells.rows[0].target_volume;
  EXPECT_GT(target, 1.4 * kVolume);
  EXPECT_NEAR(simulation->mechanics().nucleus_of(0)->volume, fraction(2.5) * target, 0.01 * fraction(2.5) * target);
  EXPECT_DOUBLE_EQ(simulation->tissue().nuclei.shells.rest_volume[0], fraction(2.5) * target);
}

}  // namespace
}  // namespace morula
