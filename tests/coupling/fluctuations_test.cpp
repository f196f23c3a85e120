#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kEnergy = 4.2821e-3;  // a thousand times the thermal one [nN·µm]

Mechanics make_mechanics(const Model& model, ShapeLibrary& shapes) {
  return Mechanics(model, contact_obstacles(model).value(), shapes, Comm(), 1);
}

Model fluctuating(double adhesion = 0.1) {
  Model model = test::clusters_model(adhesion);
  model.types[0].fluctuations.energy = kEnergy;
  model.step.first_tolerance = 1e-4;  // what a study with fluctuations has: rigid motion is resolved last
  return model;
}

/// All points in the order of external forces.
std::vector<Vec3d> external_points(const Tissue& tissue) {
  std::vector<Vec3d> out = tissue.shells.position;
  out.insert(out.end(), tissue.spheres.position.begin(), tissue.spheres.position.end());
  for (const auto& center : tissue.shells.nucleus)
    if (center) out.push_back(*center);
  out.insert(out.end(), tissue.nuclei.shells.position.begin(), tissue.nuclei.shells.position.end());
  return out;
}

double work(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  double out = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) out += dot(a[i], b[i]);
  return out;
}

/// ⟨(w·f)²⟩ = (2 k_B T/Δt) wᵀΓw for any w. wᵀΓw is measured from the other side: the explicit step under a large force g solves Γv = F + g,
/// so that w = v(g) − v(0) has Γw = g and wᵀΓw = w·g.
void expect_covariance(const Model& model, Tissue tissue, const std::vector<Vec3d>& push, double tolerance) {
  ShapeLibrary shapes;
  constexpr double kStep = 0.5, kShort = 1e-3;
  Model stepping = model;
  for (CellType& type : stepping.types) type.fluctuations.energy = 0.0;
  stepping.step.integrator = Integrator::kExplicitEuler;
  std::vector<Vec3d> way[2];
  for (const bool pushed : {false, true}) {
    Tissue moved = tissue;
    Mechanics mechanics = make_mechanics(stepping, shapes);
    std::vector<Vec3d> external(push.size());
    if (pushed) external = push;
    ASSERT_TRUE(mechanics.step(moved, kShort, external).ok());
    way[pushed] = external_points(moved);
  }
  std::vector<Vec3d> w;
  for (std::size_t i = 0; i < push.size(); ++i) w.push_back((way[1][i] - way[0][i]) * (1.0 / kShort));
  const double expected = 2.0 * kEnergy / kStep * work(w, push);
  Mechanics mechanics = make_mechanics(model, shapes);
  double sum = 0.0, mean = 0.0;
  constexpr int kSamples = 4000;
  for (int k = 0; k < kSamples; ++k) {
    tissue.clock.steps = static_cast<std::uint64_t>(k);
    const double value = work(w, mechanics.random_forces(tissue, kStep));
    sum += value * value / kSamples;
    mean += value / kSamples;
  }
  EXPECT_NEAR(sum / expected, 1.0, tolerance);
  EXPECT_LT(std::abs(mean), 4.0 * std::sqrt(expected / kSamples));
}

/// A push that is different at every point.
std::vector<Vec3d> uneven_push(const Tissue& tissue, double size) {
  std::vector<Vec3d> out;
  for (const Vec3d& x : external_points(tissue)) out.push_back(Vec3d{std::sin(x.y + 1.0), std::cos(2.0 * x.z), std::sin(x.x - x.y)} * size);
  return out;
}

TEST(Fluctuations, HaveTheCovarianceOfAllFrictionOfAShell) {  // medium across and along, edges, isotropic, volume
  Model model = fluctuating();
  auto& type = model.types[0];
  type.shell.medium_friction = 0.05;
  type.medium_normal_extra = 0.15;
  type.shell.edge_damping = 0.4;
  type.shell.isotropic_damping = 0.02;
  type.shell.bulk_viscosity = 0.3;
  ShapeLibrary shapes;
  const Tissue tissue = test::make_tissue(model, shapes, {{1, 2, 3}}, {BodyKind::kShell}, 42);
  std::vector<Vec3d> push = uneven_push(tissue, 0.05);
  expect_covariance(model, tissue, push, 0.07);  // 3 standard errors of 4000 samples
  for (std::size_t i = 0; i < push.size(); ++i)
    push[i] = normalized(tissue.shells.position[i] - Vec3d{1, 2, 3}) * 0.05;  // the volume breathes
  expect_covariance(model, tissue, push, 0.07);
}

TEST(Fluctuations, HaveTheCovarianceOfTheFrictionOfContacts) {
  Model model = fluctuating();
  model.pairs = {ContactPair{0.1, 50.0, 5.0}};
  ShapeLibrary shapes;
  const Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {0, 0, 11.9}, {0, 11.5, 5.9}, {0, 22, 7}},
                                          {BodyKind::kShell, BodyKind::kShell, BodyKind::kSphere, BodyKind::kSphere}, 42);
  expect_covariance(model, tissue, uneven_push(tissue, 0.02), 0.07);
}

/// A cell with something inside, whose friction is mostly that of what is inside.
Model with_interior(std::uint32_t nucleus_nodes) {
  Model model = fluctuating();
  auto& type = model.types[0];
  type.shell.medium_friction = type.medium_friction = 0.02;
  type.shell.edge_damping = 0.1;
  dcm::InteriorParameters& inside = type.interior;
  inside.nucleus_fraction = 0.125;
  inside.cytoplasm_viscosity = 0.05;
  inside.nucleus_links = {20, 0.05, 0.4, false};
  if (nucleus_nodes == 0) inside.cortex_links = {10, 0.05, 0.4, false};
  inside.nucleus_nodes = nucleus_nodes;
  inside.nucleus_shell.spring_stiffness = 0.2;
  inside.nucleus_shell.bulk_modulus = 2.5;
  inside.nucleus_shell.edge_damping = 0.1;
  inside.nucleus_shell.isotropic_damping = 0.05;
  inside.nucleus_shell.bulk_viscosity = 0.5;
  return model;
}

TEST(Fluctuations, HaveTheCovarianceOfTheFrictionOfANucleusAndLinks) {
  for (const std::uint32_t nucleus_nodes : {0u, 42u}) {
    const Model model = with_interior(nucleus_nodes);
    ShapeLibrary shapes;
    const Tissue tissue = test::make_tissue(model, shapes, {{1, 2, 3}}, {BodyKind::kShell}, 42);
    std::vector<Vec3d> push = uneven_push(tissue, 0.02);
    ASSERT_EQ(push.size(), nucleus_nodes == 0 ? 43u : 84u);
    expect_covariance(model, tissue, push, 0.07);
    for (std::size_t i = 0; i < push.size(); ++i)
      push[i] = Vec3d{0.0, 0.0, i < 42 ? 0.0 : 0.1 / (push.size() - 42.0)};  // through the cytoplasm
    expect_covariance(model, tissue, push, 0.07);
  }
}

/// A nucleus that links hold at the centre of its cell: its distance from there has the variance k_B T/k along each axis, k the slope of the
/// force that holds it, by equipartition and whatever rubs; under the implicit step (k_B T/k)/(1 + Δt/(2τ)). Without the noise of the friction
/// inside the cell, which is all that moves the nucleus, it would stand still.
/// Most of its friction is that of its volume: without the noise of that the covariance would be a small part.
TEST(Fluctuations, HaveTheCovarianceOfANuclearShellThatBreathes) {
  Model model = with_interior(42);
  model.types[0].interior.nucleus_shell.bulk_viscosity = 20.0;
  ShapeLibrary shapes;
  const Tissue tissue = test::make_tissue(model, shapes, {{1, 2, 3}}, {BodyKind::kShell}, 42);
  std::vector<Vec3d> push(84);
  for (std::size_t i = 42; i < push.size(); ++i) push[i] = normalized(tissue.nuclei.shells.position[i - 42] - Vec3d{1, 2, 3}) * 0.05;
  expect_covariance(model, tissue, push, 0.07);
}

TEST(Fluctuations, HoldTheNucleusAtItsThermalDistanceFromTheCentre) {
  Model model = fluctuating();
  auto& type = model.types[0];
  type.fluctuations.energy = 1e-4;
  type.shell.medium_friction = type.medium_friction = 20.0;  // the cortex stands nearly still meanwhile
  type.interior.nucleus_fraction = 0.03;
  type.interior.cytoplasm_viscosity = 0.02;
  type.interior.nucleus_links = {dcm::LinkParameters::kAll, 0.004, 0.001, false};
  model.step.max_displacement = 3.0;
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 42);
  // The slope of the force on the nucleus from the energy alone: all nodes stay, the nucleus is moved.
  const auto energy_at = [&](const Vec3d& off) {
    Tissue moved = tissue;
    *moved.shells.nucleus[0] += off;
    std::vector<Vec3d> ignored;
    return make_mechanics(model, shapes).energy_and_forces(moved, ignored);
  };
  constexpr double kOff = 0.02;
  const double stiffness = (energy_at({kOff, 0, 0}) + energy_at({-kOff, 0, 0}) - 2.0 * energy_at({})) / (kOff * kOff);
  // Its friction: drag, and the dampers, which point in all directions alike.
  const double radius = dcm::nucleus_radius(type.interior, tissue.shells.rest_volume[0]);
  const double friction = 6.0 * std::numbers::pi * 0.02 * radius + 42.0 * 0.001 / 3.0;
  const double relaxation = friction / stiffness, dt = 0.5 * relaxation;
  Mechanics mechanics = make_mechanics(model, shapes);
  const std::vector<Vec3d> none(Mechanics::external_size(tissue));
  double square = 0.0;
  constexpr int kWarm = 50, kCount = 6000;
  for (int k = 0; k < kWarm + kCount; ++k, ++tissue.clock.steps) {
    ASSERT_TRUE(mechanics.step(tissue, dt, none).ok());
    Vec3d centre{};
    for (const Vec3d& x : tissue.shells.position) centre += x * (1.0 / 42.0);
    if (k >= kWarm) square += norm2(*tissue.shells.nucleus[0] - centre) / (3.0 * kCount);
  }
  const double expected = 1e-4 / stiffness / (1.0 + dt / (2.0 * relaxation));
  // 18,000 numbers, correlated over 3.9 of them: a standard error of 2 %.
  EXPECT_NEAR(square / expected, 1.0, 0.06);
}

/// Random forces come on top of those from outside: with the same numbers and a force beside them, a sphere goes Δt F/(γ A) further.
TEST(Fluctuations, LeaveForcesFromOutsideAsTheyAre) {
  const Model model = fluctuating();
  ShapeLibrary shapes;
  const Tissue at_start = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kSphere});
  Vec3d end[2];
  for (const bool pushed : {false, true}) {
    Tissue tissue = at_start;
    ASSERT_TRUE(make_mechanics(model, shapes).step(tissue, 0.5, std::vector<Vec3d>{{pushed ? 2.0 : 0.0, 0.0, 0.0}}).ok());
    end[pushed] = tissue.spheres.position[0];
  }
  const double friction = model.types[0].medium_friction * 4.0 * std::numbers::pi * 36.0;
  EXPECT_GT(norm(end[0]), 0.0);
  EXPECT_NEAR((end[1] - end[0]).x, 0.5 * 2.0 / friction, 1e-6);
  EXPECT_NEAR((end[1] - end[0]).y, 0.0, 1e-6);
}

TEST(Fluctuations, BetweenPointsHaveNoSumAndNoTorque) {
  Model model = fluctuating();
  model.types[0].shell.medium_friction = model.types[0].medium_friction = 1e-12;
  model.types[0].shell.bulk_viscosity = 0.3;
  ShapeLibrary shapes;
  const Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {0, 0, 11.9}}, {BodyKind::kShell, BodyKind::kShell}, 162);
  Mechanics mechanics = make_mechanics(model, shapes);
  const auto f = mechanics.random_forces(tissue, 1.0);
  Vec3d sum{};
  double size = 0.0;
  for (const Vec3d& each : f) sum += each, size += norm(each);
  EXPECT_GT(size, 1.0);
  EXPECT_LT(norm(sum), 1e-6 * size);
}

TEST(Fluctuations, AreThoseOfCellAndStepAndGrowWithTheRootOfTheRate) {
  const Model model = fluctuating();
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 42);
  Mechanics mechanics = make_mechanics(model, shapes), again = make_mechanics(model, shapes);
  const auto a = mechanics.random_forces(tissue, 1.0), b = again.random_forces(tissue, 4.0);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(norm(a[i] - b[i] * 2.0), 0.0, 1e-14);
  tissue.clock.steps = 1;
  EXPECT_GT(norm(mechanics.random_forces(tissue, 1.0)[0] - a[0]), 1e-3);
}

/// T10.2: a free cell diffuses with D = k_B T/(γ A), whatever its other friction and however long the steps.
TEST(Fluctuations, MoveAFreeCellByTheEinsteinRelation) {
  Model model = fluctuating();
  model.step.max_displacement = 3.0;  // steps are never refused for their noise: that would choose the small ones
  model.step.max_step = 2.0;
  model.step.initial_step = 2.0;
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 42);
  auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
  // The centre that diffuses is that of friction: the nodes by their areas.
  const auto way = [](const dcm::Shells& from, const dcm::Shells& to, double& whole) {
    Vec3d out{};
    whole = 0.0;
    for (const Triangle& t : from.topology(0).faces()) {
      const auto& x = from.position;
      const double area = 0.5 * norm(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]));
      for (const std::uint32_t i : t) out += (to.position[i] - x[i]) * (area / 3.0);
      whole += area;
    }
    return out * (1.0 / whole);
  };
  double sum = 0.0, area = 0.0;
  constexpr int kSteps = 8000;
  for (int k = 0; k < kSteps; ++k) {
    const dcm::Shells before = simulation->tissue().shells;
    ASSERT_TRUE(simulation->step(1e9).ok());
    double whole = 0.0;
    sum += norm2(way(before, simulation->tissue().shells, whole));
    area += whole / kSteps;
  }
  const double d = sum / (6.0 * simulation->tissue().clock.time);
  EXPECT_NEAR(d / (kEnergy / (0.1 * area)), 1.0, 0.03);  // the standard error is 0.9 %
}

/// Modes of the surface are those of the implicit step: (k_B T/k)/(1 + Δt/(2τ)). A free cell of springs alone is compared with itself at small
/// steps through one number that is the same whatever the mesh: the energy of all modes, ½ k_B T each by equipartition.
TEST(Fluctuations, ShareTheEnergyEquallyWhereStepsResolveTheModes) {
  for (const double dt : {0.02, 0.4}) {
    Model model = fluctuating();
    auto& shell = model.types[0].shell;
    shell = {};
    shell.tension = shell.shape_stiffness = shell.barrier_stiffness = shell.hinge_stiffness = 0.0;
    shell.edge_damping = 0.0;
    shell.spring_stiffness = 0.173;
    shell.bulk_modulus = 2.5;
    model.types[0].fluctuations.energy = 1e-5;  // displacements stay linear
    model.step.max_step = model.step.initial_step = dt;
    model.step.first_tolerance = 1e-4;
    ShapeLibrary shapes;
    Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 42);
    auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
    double energy = 0.0;
    const int warm = static_cast<int>(40.0 / dt), count = dt < 0.1 ? 6000 : 3000;
    for (int k = 0; k < warm + count; ++k) {
      const auto done = simulation->step(1e9);
      ASSERT_TRUE(done.ok());
      if (k >= warm) energy += done->mechanics.energy / count;
    }
    // 42 nodes: 126 modes, 6 of them rigid.
    const double per_mode = energy / (0.5 * 1e-5 * 120.0);
    if (dt < 0.1) {
      EXPECT_NEAR(per_mode, 1.0, 0.05);
    } else {
      EXPECT_LT(per_mode, 0.95) << "fast modes come out too small";
    }
  }
}

/// T10.1: the modes of a sphere under tension (Milner & Safran 1987): ⟨|u_2m|²⟩ = k_B T/(γ R² (l − 1)(l + 2)) in units of R², which is 5.946e-8 at
/// 310 K and γ = 0.5, R = 6; here at ten times the temperature, and with the bias of the implicit step 1/(1 + Δt/(2τ)),
/// τ = γ_med R²/(γ (l − 1)(l + 2)) = 1.8 s.
TEST(Fluctuations, GiveTheModesOfATenseSphere) {
  Model model = fluctuating();
  auto& shell = model.types[0].shell;
  shell.spring_stiffness = shell.hinge_stiffness = shell.edge_damping = 0.0;
  shell.shape_stiffness = 0.1;                          // holds triangles together; no shear modulus
  model.types[0].fluctuations.energy = 0.01 * kEnergy;  // nodes stay where they are to a few hundredths of an edge
  shell.bulk_modulus = 50.0;
  constexpr double dt = 0.2, kRelaxation = 0.1 * 36.0 / (0.5 * 4.0);
  model.step.max_step = model.step.initial_step = dt;
  model.step.max_displacement = 1.0;
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 162);
  auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
  double square = 0.0;
  int count = 0;
  while (simulation->tissue().clock.time < 1200.0) {
    ASSERT_TRUE(simulation->step(1e9).ok());
    if (simulation->tissue().clock.steps % 4 != 0 || simulation->tissue().clock.time < 20.0) continue;
    const dcm::Shells& shells = simulation->tissue().shells;
    const Vec3d center = simulation->centers()[0];
    double mode[5] = {};  // ∫ ρ Y_2m dΩ over the faces, ρ the distance in units of R
    for (const Triangle& t : shells.topology(0).faces()) {
      const Vec3d a = shells.position[t[0]] - center, b = shells.position[t[1]] - center, c = shells.position[t[2]] - center;
      const Vec3d middle = (a + b + c) * (1.0 / 3.0), n = normalized(middle);
      const double rho = norm(middle), angle = dot(cross(b - a, c - a) * 0.5, n) / (rho * rho);
      const double y[5] = {0.546274 * (n.x * n.x - n.y * n.y), 1.092548 * n.x * n.y, 1.092548 * n.x * n.z, 1.092548 * n.y * n.z,
                           0.315392 * (3.0 * n.z * n.z - 1.0)};
      for (int m = 0; m < 5; ++m) mode[m] += y[m] * rho / 6.0 * angle;
    }
    for (const double u : mode) square += u * u;
    ++count;
  }
  // On this mesh, computed independently: the stiffness of the mode is 0.9704 of the sphere's, and the sum above sees 1.0413 of its amplitude.
  const double expected = 5.946e-8 * 10.0 / (1.0 + dt / (2.0 * kRelaxation)) * 1.0413 * 1.0413 / 0.9704;
  EXPECT_NEAR(square / (5.0 * count) / expected, 1.0, 0.1);  // 3 standard errors
}

/// Every node of a shell of 42 nodes on a spring of its own, k_i = γ a_i/τ, is 126 oscillators whose variance under the implicit step is
/// (k_B T/k_i)/(1 + Δt/(2τ)) exactly: x ← (Γ x + Δt f)/(Γ + Δt k). Their mean of 500 steps is good to 0.7 %.
TEST(Fluctuations, HoldNodesOnSpringsAtTheirThermalVariance) {
  constexpr double kSmall = 1e-5, kRelaxation = 10.0;  // k_B T [nN·µm], so small that areas stay; τ [s]
  for (const double dt : {2.0, 10.0}) {
    Model model = fluctuating();
    auto& type = model.types[0];
    type.fluctuations.energy = kSmall;
    auto& shell = type.shell;
    shell.spring_stiffness = shell.hinge_stiffness = shell.tension = shell.shape_stiffness = shell.barrier_stiffness = 0.0;
    shell.edge_damping = shell.bulk_modulus = 0.0;
    ShapeLibrary shapes;
    Tissue tissue = test::make_tissue(fluctuating(), shapes, {{0, 0, 0}}, {BodyKind::kShell}, 42);
    const std::vector<Vec3d> home = tissue.shells.position;
    std::vector<Anchor> anchors;
    for (std::uint32_t i = 0; i < 42; ++i) anchors.push_back({i, 0.0, home[i]});
    for (const Triangle& t : tissue.shells.topology(0).faces())
      for (const std::uint32_t i : t)
        anchors[i].stiffness += 0.1 / kRelaxation * norm(cross(home[t[1]] - home[t[0]], home[t[2]] - home[t[0]])) / 6.0;
    Mechanics mechanics = make_mechanics(model, shapes);
    const std::vector<Vec3d> none(home.size());
    double square = 0.0;  // Σ k |x − X|² over the number of oscillators
    const int warm = static_cast<int>(5.0 * kRelaxation / dt), count = static_cast<int>(5000.0 / dt);
    for (int k = 0; k < warm + count; ++k, ++tissue.clock.steps) {
      ASSERT_TRUE(mechanics.step(tissue, dt, none, anchors).ok());
      for (std::size_t i = 0; k >= warm && i < 42; ++i)
        square += anchors[i].stiffness * norm2(tissue.shells.position[i] - home[i]) / (126.0 * count);
    }
    EXPECT_NEAR(square / (kSmall / (1.0 + dt / (2.0 * kRelaxation))), 1.0, 0.03) << dt;
  }
}

/// T10.1 without tension: a mode l = 2 that bending alone resists, and that a force h deflects by χ h, fluctuates by k_B T χ. That χ of a
/// fine mesh is 1/(24 κ), from which 2.007e-4 follows, is in dcm/sphere_modes_test.cpp; on 42 nodes, where nodes can also give way along
/// the surface, χ is measured.
TEST(Fluctuations, OfABendingModeAreThoseOfItsResponse) {
  constexpr double kRigidity = 8.8889e-4, kRadius = 6.0, kCold = 1e-4;  // part of the temperature, at which all is linear
  Model model = fluctuating();
  auto& shell = model.types[0].shell;
  shell.spring_stiffness = shell.hinge_stiffness = shell.tension = shell.edge_damping = shell.barrier_stiffness = 0.0;
  shell.shape_stiffness = 0.0;
  shell.helfrich_rigidity = kRigidity;
  model.types[0].fluctuations.energy = kCold * 1e-3 * kEnergy;
  model.step.newton_stop = 0.01;
  model.step.max_newton = 10;
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 42);
  const std::vector<Vec3d> home = tissue.shells.position;
  // Modes by node: Σ w_i·(x_i − X_i) = ∫ u Y_2m dΩ with u in units of R.
  std::vector<Vec3d> weight[5];
  for (auto& w : weight) w.resize(home.size());
  for (const Triangle& t : tissue.shells.topology(0).faces())
    for (const std::uint32_t i : t) {
      const Vec3d n = normalized(home[i]);
      const double part = norm(cross(home[t[1]] - home[t[0]], home[t[2]] - home[t[0]])) / 6.0 / (kRadius * kRadius * kRadius);
      const double y[5] = {0.546274 * (n.x * n.x - n.y * n.y), 1.092548 * n.x * n.y, 1.092548 * n.x * n.z, 1.092548 * n.y * n.z,
                           0.315392 * (3.0 * n.z * n.z - 1.0)};
      for (int m = 0; m < 5; ++m) weight[m][i] += n * (part * y[m]);
    }
  const auto amplitude = [&](int m) {
    double out = 0.0;
    for (std::size_t i = 0; i < home.size(); ++i) out += dot(weight[m][i], tissue.shells.position[i] - home[i]);
    return out;
  };
  Model cold = model;
  cold.types[0].fluctuations.energy = 0.0;
  Mechanics mechanics = make_mechanics(model, shapes), still = make_mechanics(cold, shapes);
  const std::vector<Vec3d> none(home.size());
  constexpr double kHold = 0.25;  // of the stiffness of the modes: springs by area that keep nodes from wandering along the surface
  std::vector<Anchor> anchors;
  for (std::uint32_t i = 0; i < home.size(); ++i) anchors.push_back({i, 0.0, home[i]});
  for (const Triangle& t : tissue.shells.topology(0).faces())
    for (const std::uint32_t i : t)
      anchors[i].stiffness += kHold * 24.0 * kRigidity * norm(cross(home[t[1]] - home[t[0]], home[t[2]] - home[t[0]])) / 6.0 /
                              (kRadius * kRadius * kRadius * kRadius);
  constexpr double kStiffness = 24.0 * kRigidity * (1.0 + kHold), kRelaxation = 0.1 * kRadius * kRadius * kRadius * kRadius / kStiffness;
  for (int k = 0; k < 40; ++k) ASSERT_TRUE(still.step(tissue, k < 10 ? 300.0 : 3.0 * kRelaxation, none, anchors).ok());
  double rest[5], deflection = 0.0;
  for (int m = 0; m < 5; ++m) rest[m] = amplitude(m);
  const Tissue at_rest = tissue;
  constexpr double kForce = 1e-3 * kStiffness;
  for (int m = 0; m < 5; ++m) {
    std::vector<Vec3d> force;
    for (const Vec3d& w : weight[m]) force.push_back(w * kForce);
    tissue = at_rest;
    still.bodies_changed();  // else it takes positions for its own
    for (int k = 0; k < 12; ++k) ASSERT_TRUE(still.step(tissue, 3.0 * kRelaxation, force, anchors).ok());
    deflection += (amplitude(m) - rest[m]) / (5.0 * kForce);
  }
  tissue = at_rest;
  mechanics.bodies_changed();
  constexpr double dt = 0.5 * kRelaxation;
  double square = 0.0;
  constexpr int kWarm = 10, kCount = 2000;
  for (int k = 0; k < kWarm + kCount; ++k, ++tissue.clock.steps) {
    ASSERT_TRUE(mechanics.step(tissue, dt, none, anchors).ok());
    for (int m = 0; k >= kWarm && m < 5; ++m) square += std::pow(amplitude(m) - rest[m], 2) / (5.0 * kCount);
  }
  const double bias = 1.0 / (1.0 + dt / (2.0 * kRelaxation * kStiffness * deflection));  // of the implicit step; τ goes with χ
  EXPECT_NEAR(square / (kCold * 1e-3 * kEnergy * deflection * bias), 1.0, 0.07);         // 3 standard errors
}

}  // namespace
}  // namespace morula
