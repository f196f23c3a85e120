#include "coupling/lumens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/face_marks.h"
#include "coupling/mechanics/contact_setup.h"
#include "coupling/sight.h"
#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kDistance = 30.0, kRadius = 19.0;

/// Centres of twelve balls about the origin that leave no gap: along the corners of an icosahedron.
std::vector<Vec3d> walls() {
  std::vector<Vec3d> out;
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  for (const double a : {-1.0, 1.0})
    for (const double b : {-golden, golden})
      for (const Vec3d& p : {Vec3d{0, a, b}, Vec3d{a, b, 0}, Vec3d{b, 0, a}}) out.push_back(normalized(p) * kDistance);
  return out;
}

Model model_of_cavity() {
  Model model = test::clusters_model();
  model.mark_names = {"cavity"};
  Lumen lumen;
  lumen.name = "cavity";
  lumen.center = {0.3, -0.2, 0.1};
  lumen.pressure = 0.02;
  model.lumens = {lumen};
  return model;
}

Tissue closed_cavity(const Model& model, ShapeLibrary& shapes, std::uint32_t nodes = 642) {
  Tissue tissue = test::make_tissue(model, shapes, walls(), std::vector(12, BodyKind::kShell), nodes, kRadius);
  mark_new_shells(model, tissue);
  return tissue;
}

/// ∫ ρ³/3 dΩ over directions, ρ the way to the nearest of the balls: the volume that the balls enclose about the origin.
double enclosed_between_balls(const std::vector<Vec3d>& center = walls()) {
  double sum = 0.0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {  // Fibonacci points
    const double z = 1.0 - (2.0 * i + 1.0) / kCount, rho = std::sqrt(1.0 - z * z), angle = 2.399963229728653 * i;
    const Vec3d ray{rho * std::cos(angle), rho * std::sin(angle), z};
    double nearest = 1e300;
    for (const Vec3d& c : center) {
      const double half = dot(ray, c), root = half * half - (norm2(c) - kRadius * kRadius);
      if (root >= 0.0 && half - std::sqrt(root) > 0.0) nearest = std::min(nearest, half - std::sqrt(root));
    }
    sum += nearest * nearest * nearest / 3.0;
  }
  return 4.0 * std::numbers::pi * sum / kCount;
}

TEST(Lumen, FacesInSightCloseTheCavityAndEncloseItsVolume) {
  const Model model = model_of_cavity();
  ShapeLibrary shapes;
  Tissue tissue = closed_cavity(model, shapes);
  look_into_lumens(model, {}, tissue, Comm());
  ASSERT_EQ(tissue.lumens.size(), 1u);
  const LumenState& state = tissue.lumens[0];
  EXPECT_NEAR(state.covered, 1.0, 0.04);  // T15.2; the rims of neighbours meet within the size of a face
  EXPECT_NEAR(state.volume / enclosed_between_balls(), 1.0, 0.04);
  EXPECT_EQ(state.pressure, 0.02);
  std::size_t marked = 0, back = 0;
  for (std::size_t s = 0; s < 12; ++s) {
    const auto x = std::as_const(tissue.shells).nodes(s);
    for (std::size_t f = 0; f < tissue.shells.faces_of(s).mark.size(); ++f) {
      if (tissue.shells.faces_of(s).mark[f] == 0) continue;
      ++marked;
      const Triangle& t = tissue.shells.topology(s).faces()[f];
      back += dot(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]), x[t[0]] - model.lumens[0].center) > 0.0;
    }
  }
  EXPECT_GT(marked, 200u);
  EXPECT_EQ(back, 0u);
}

TEST(Lumen, SpheresAmongItsWallsBoundItToo) {
  const Model model = model_of_cavity();
  ShapeLibrary shapes;
  std::vector<BodyKind> bodies(12, BodyKind::kShell);
  bodies[0] = bodies[3] = bodies[7] = BodyKind::kSphere;
  auto centers = walls();
  centers[3] = centers[3] * 0.8;  // bulges into the cavity
  Tissue tissue = test::make_tissue(model, shapes, centers, bodies, 642, kRadius);
  mark_new_shells(model, tissue);
  look_into_lumens(model, {}, tissue, Comm());
  EXPECT_NEAR(tissue.lumens[0].covered, 1.0, 0.04);
  EXPECT_NEAR(tissue.lumens[0].volume / enclosed_between_balls(centers), 1.0, 0.04);
}

/// What each of the twelve bears, a shell or a sphere, and nothing is left over.
TEST(Lumen, PressesOnSpheresAmongItsWallsAsOnShells) {
  const Model model = model_of_cavity();
  ShapeLibrary shapes;
  std::vector<BodyKind> bodies(12, BodyKind::kShell);
  bodies[0] = bodies[3] = bodies[7] = BodyKind::kSphere;
  const auto borne = [&](const std::vector<BodyKind>& as) {
    Tissue tissue = test::make_tissue(model, shapes, walls(), as, 642, kRadius);
    mark_new_shells(model, tissue);
    look_into_lumens(model, {}, tissue, Comm());
    std::vector<Vec3d> force(tissue.shells.node_count()), out;
    add_lumen_forces(model, tissue, 0.0, Comm(), force);
    const std::vector<Vec3d> on_spheres = pushes_on_spheres(model, tissue, 0.0);
    for (const BodyOfRow& body : bodies_of(tissue.cells)) {
      Vec3d sum{};
      if (body.is_shell)
        for (std::uint32_t i = tissue.shells.first_node[body.number]; i < tissue.shells.first_node[body.number + 1]; ++i) sum += force[i];
      else
        sum = on_spheres[body.number];
      out.push_back(sum);
    }
    return out;
  };
  const std::vector<Vec3d> alone = borne(std::vector(12, BodyKind::kShell)), mixed = borne(bodies);
  Vec3d sum{};
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_LT(norm(mixed[i] - alone[i]), 0.05 * norm(alone[i])) << i;
    sum += mixed[i];
  }
  EXPECT_LT(norm(sum), 1e-12 * 12.0 * norm(alone[0]));
}

/// P ∫ n dA at a distance R from its centre, as any force that pushes it inwards: −tr σ/3 = R P |∫ n dA|/(3V).
TEST(Lumen, PressesASphereTogether) {
  const Model model = model_of_cavity();
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{kDistance, 0, 0}}, {BodyKind::kSphere}, 162, kRadius);
  look_into_lumens(model, {}, tissue, Comm());
  tissue.lumens[0].covered = 1.0;  // as if the wall were closed
  const double push = norm(pushes_on_spheres(model, tissue, 0.0)[0]);
  EXPECT_GT(push, 0.02 * 100.0);
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 3), expected = kRadius * push / (3.0 * volume);
  EXPECT_NEAR(mechanics.pressures(tissue)[0], expected, 0.01 * expected);
  EXPECT_NEAR(mechanics.values(tissue).stress[0].xx, -3.0 * expected, 0.1 * expected);
}

/// The walls are what they are without it.
TEST(Lumen, LeavesOutACellThatLiesOverItsCentre) {
  Model model = model_of_cavity();
  model.lumens[0].renewed = 10.0;
  for (const BodyKind kind : {BodyKind::kSphere, BodyKind::kShell}) {
    ShapeLibrary shapes;
    std::vector<Vec3d> at = walls();
    at.push_back({200.0, 0, 0});  // beyond the eye's reach
    std::vector<BodyKind> bodies(13, BodyKind::kShell);
    bodies.back() = kind;
    Tissue tissue = test::make_tissue(model, shapes, at, bodies, 162, kRadius);
    mark_new_shells(model, tissue);
    look_into_lumens(model, {}, tissue, Comm());
    const LumenState before = tissue.lumens[0];
    EXPECT_EQ(before.hidden, 0.0);
    const auto move_last = [&](const Vec3d& way) {
      if (kind == BodyKind::kSphere)
        tissue.spheres.position.back() += way;
      else
        for (Vec3d& x : tissue.shells.nodes(12)) x += way;
      tissue.clock.time += 20.0;
      look_into_lumens(model, {}, tissue, Comm());
    };
    move_last({-198.0, 0, 0});
    EXPECT_EQ(tissue.lumens[0].hidden, 1.0);
    EXPECT_EQ(tissue.lumens[0].volume, before.volume);
    EXPECT_EQ(tissue.lumens[0].pressure, before.pressure);
    EXPECT_EQ(tissue.lumens[0].covered, before.covered);
    for (const Vec3d& push : pushes_on_spheres(model, tissue, tissue.clock.time)) EXPECT_EQ(norm(push), 0.0);
    move_last({198.0, 0, 0});
    EXPECT_EQ(tissue.lumens[0].hidden, 0.0);
    EXPECT_EQ(tissue.lumens[0].volume, before.volume);
  }
}

TEST(Lumen, PushesOutwardsWithoutDrivingTheTissue) {
  const Model model = model_of_cavity();
  ShapeLibrary shapes;
  Tissue tissue = closed_cavity(model, shapes);
  look_into_lumens(model, {}, tissue, Comm());
  std::vector<Vec3d> force(tissue.shells.node_count());
  add_lumen_forces(model, tissue, 0.0, Comm(), force);
  Vec3d sum{};
  double outward = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) sum += force[i], outward += dot(force[i], tissue.shells.position[i]);
  EXPECT_LT(norm(sum), 1e-12 * 0.02 * tissue.lumens[0].area);
  EXPECT_NEAR(outward / (3.0 * 0.02 * tissue.lumens[0].volume), tissue.lumens[0].covered, 0.05);  // Σ f·x = 3 P V
}

/// T15.3: uniform P on a closed sphere mesh, |ΣF| < 1e-12 P A.
TEST(Lumen, UniformPressureOnAClosedMeshHasNoSum) {
  Model model = model_of_cavity();
  model.lumens[0].by_sight = false;
  ShapeLibrary shapes;
  for (const std::uint32_t nodes : {162u, 642u}) {
    Tissue tissue = test::make_tissue(model, shapes, {{3, 4, 5}}, {BodyKind::kShell}, nodes);
    tissue.shells.faces_of(0).mark.assign(tissue.shells.topology(0).face_count(), 1);
    tissue.lumens = {{.looked_at = 0.0, .amount = 0.0, .volume = 1.0, .pressure = 0.02, .area = 1.0, .covered = 1.0}};
    std::vector<Vec3d> force(nodes);
    add_lumen_forces(model, tissue, 0.0, Comm(), force);
    Vec3d sum{};
    double inward = 0.0;
    for (std::size_t i = 0; i < nodes; ++i) sum += force[i], inward -= dot(force[i], tissue.shells.position[i] - Vec3d{3, 4, 5});
    EXPECT_LT(norm(sum), 1e-12 * 0.02 * 452.0);
    EXPECT_NEAR(inward, 3.0 * 0.02 * 4.0 / 3.0 * std::numbers::pi * 216.0, 1e-9);  // the mesh encloses the sphere's volume
  }
}

TEST(Lumen, KeptSolutePressesByItsConcentration) {
  Model model = model_of_cavity();
  model.lumens[0].keeps_solute = true;
  ShapeLibrary shapes;
  Tissue tissue = closed_cavity(model, shapes, 162);
  look_into_lumens(model, {}, tissue, Comm());
  const double volume = tissue.lumens[0].volume;
  EXPECT_NEAR(tissue.lumens[0].amount, 0.02 * volume / 2.578731, 1e-12 * volume);  // 19.389 µM are 50 Pa
  EXPECT_NEAR(tissue.lumens[0].pressure, 0.02, 1e-15);
  for (Vec3d& x : tissue.shells.position) x = model.lumens[0].center + (x - model.lumens[0].center) * 1.1;
  measure_lumens(model, tissue, Comm());
  EXPECT_NEAR(tissue.lumens[0].volume / volume, 1.331, 1e-9);
  EXPECT_NEAR(tissue.lumens[0].pressure, 0.02 / 1.331, 1e-11);
  EXPECT_NEAR(kGasEnergy * 19.389e-3, 50e-3, 5e-6);  // fields_and_coupling.md B
}

TEST(Lumen, HasNoPressureBeforeItExistsNorAfterItHasBurst) {
  Model model = model_of_cavity();
  model.lumens[0].from = 10.0;
  model.lumens[0].course = {{20.0, 30.0}, {1.0, 2.0}};
  LumenState state{.looked_at = 0.0, .amount = 0.0, .volume = 100.0, .pressure = 0.0, .area = 50.0, .covered = 0.97};
  EXPECT_EQ(lumen_pressure(model.lumens[0], state, 9.0), 0.0);
  EXPECT_EQ(lumen_pressure(model.lumens[0], state, 10.0), 0.02);
  EXPECT_EQ(lumen_pressure(model.lumens[0], state, 40.0), 0.04);
  state.covered = 0.49;
  EXPECT_EQ(lumen_pressure(model.lumens[0], state, 10.0), 0.0);
}

TEST(Lumen, OpensWhenAWallIsTakenAway) {
  const Model model = model_of_cavity();
  ShapeLibrary shapes;
  Tissue tissue = closed_cavity(model, shapes, 162);
  look_into_lumens(model, {}, tissue, Comm());
  const double closed = tissue.lumens[0].covered;
  for (Vec3d& x : tissue.shells.nodes(0)) x += normalized(walls()[0]) * 80.0;
  tissue.clock.time = 300.0;
  look_into_lumens(model, {}, tissue, Comm());
  EXPECT_LT(tissue.lumens[0].covered, closed - 0.03);
}

/// Cells that part show faces that were in contact: these bear the pressure at once, not after `renewed`.
TEST(Lumen, FindsItsFacesAnewAsSoonAsTheyLeaveWallsOpen) {
  const Model model = model_of_cavity();
  ShapeLibrary shapes;
  Tissue tissue = closed_cavity(model, shapes);
  look_into_lumens(model, {}, tissue, Comm());
  const auto move_out = [&](double way) {
    const std::vector<Vec3d> center = walls();
    for (std::size_t s = 0; s < 12; ++s)
      for (Vec3d& x : tissue.shells.nodes(s)) x += normalized(center[s]) * way;
  };
  move_out(0.1);
  tissue.clock.time = 1.0;
  look_into_lumens(model, {}, tissue, Comm());
  EXPECT_EQ(tissue.lumens[0].looked_at, 0.0) << "a little of the way that it takes";
  const double area = tissue.lumens[0].area;
  move_out(6.0);
  tissue.clock.time = 2.0;
  measure_lumens(model, tissue, Comm());
  EXPECT_NEAR(tissue.lumens[0].area, area, 1e-9 * area) << "the same faces";
  look_into_lumens(model, {}, tissue, Comm());
  EXPECT_EQ(tissue.lumens[0].looked_at, 2.0);
  EXPECT_GT(tissue.lumens[0].area, 1.1 * area);
  std::vector<Vec3d> force(tissue.shells.node_count());
  add_lumen_forces(model, tissue, 2.0, Comm(), force);
  double outward = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) outward += dot(force[i], tissue.shells.position[i]);
  EXPECT_NEAR(outward / (3.0 * 0.02 * tissue.lumens[0].volume), tissue.lumens[0].covered, 0.05);  // Σ f·x = 3 P V
}

/// The body of the first of the twelve is a block with a flat face to the cavity.
TEST(Lumen, IsClosedByObstaclesThatBearTheirPart) {
  Model model = model_of_cavity();
  const Vec3d out = normalized(walls()[0]), across = normalized(cross(out, Vec3d{1, 0, 0})), third = cross(out, across);
  ObstacleSpec block;
  block.name = "block";
  constexpr double kFace = 14.0;
  for (const double z : {kFace, 40.0})
    for (const double y : {-18.0, 18.0})
      for (const double x : {-18.0, 18.0}) block.position.push_back(out * z + across * x + third * y);
  block.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  const auto centers = [&] {
    std::vector<Vec3d> all = walls();
    all.erase(all.begin());
    return all;
  }();
  const auto net = [&](const std::vector<ObstacleSpec>& obstacles, Tissue& tissue) {
    Model with = model;
    with.obstacles = obstacles;
    with.pairs.assign(with.material_count() * with.material_count(), ContactPair{});
    const auto surfaces = contact_obstacles(with).value();
    tissue.obstacle_offset.assign(surfaces.size(), {});
    look_into_lumens(with, surfaces, tissue, Comm());
    std::vector<Vec3d> force(tissue.shells.node_count());
    add_lumen_forces(with, tissue, 0.0, Comm(), force);
    Vec3d sum{};
    for (const Vec3d& f : force) sum += f;
    return sum;
  };
  ShapeLibrary shapes;
  Tissue open = test::make_tissue(model, shapes, centers, std::vector(11, BodyKind::kShell), 642, kRadius);
  mark_new_shells(model, open);
  Tissue closed = open;
  const Vec3d without = net({}, open);
  EXPECT_LT(norm(without), 1e-12 * 0.02 * open.lumens[0].area);
  EXPECT_LT(open.lumens[0].covered, 0.95);

  const Vec3d on_cells = net({block}, closed);
  const LumenState& state = closed.lumens[0];
  EXPECT_NEAR(state.covered, 1.0, 0.04);
  // What the block bears: P times the part of its face between the eleven balls; the cells bear the opposite.
  double volume = 0.0, face = 0.0;
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {  // Fibonacci points
    const double z = 1.0 - (2.0 * i + 1.0) / kCount, rho = std::sqrt(1.0 - z * z), angle = 2.399963229728653 * i;
    const Vec3d ray{rho * std::cos(angle), rho * std::sin(angle), z};
    const double along = dot(ray, out), plane = along > 0.0 ? kFace / along : 1e300;
    double nearest = plane;
    for (const Vec3d& c : centers) {
      const double half = dot(ray, c), root = half * half - (norm2(c) - kRadius * kRadius);
      if (root >= 0.0 && half - std::sqrt(root) > 0.0) nearest = std::min(nearest, half - std::sqrt(root));
    }
    volume += nearest * nearest * nearest / 3.0;
    if (nearest == plane) face += plane * plane / along;
  }
  volume *= 4.0 * std::numbers::pi / kCount, face *= 4.0 * std::numbers::pi / kCount;
  EXPECT_NEAR(state.volume / volume, 1.0, 0.04);
  EXPECT_NEAR(state.wall_x * out.x + state.wall_y * out.y + state.wall_z * out.z, face, 0.04 * face);
  EXPECT_NEAR(-dot(on_cells, out), 0.02 * face, 0.04 * 0.02 * face);
  EXPECT_LT(norm(cross(on_cells, out)), 0.02 * 0.02 * face);
}

TEST(SightMap, MeasuresWhatItSeesOfAWall) {
  SightMap map({0, 0, 0}, 50.0);
  map.add_wall({-10, -10, -5}, {10, -10, -5}, {10, 10, -5});  // turned either way
  map.add_wall({-10, -10, -5}, {-10, 10, -5}, {10, 10, -5});
  map.add_wall({-40, -40, -8}, {40, -40, -8}, {0, 3, -8});  // behind it, for the most part beside it
  map.join(Comm());
  EXPECT_TRUE(map.seen().empty());
  SightMap square({0, 0, 0}, 50.0);
  square.add_wall({-10, -10, -5}, {10, -10, -5}, {10, 10, -5});
  square.add_wall({-10, -10, -5}, {-10, 10, -5}, {10, 10, -5});
  square.join(Comm());
  const auto seen = square.in_the_way(Comm());
  EXPECT_NEAR(seen.volume / (400.0 * 5.0 / 3.0), 1.0, 5e-3);
  EXPECT_NEAR(seen.directions, 4.0 * std::asin(100.0 / 125.0) / (4.0 * std::numbers::pi), 1e-3);
  EXPECT_NEAR(seen.normal.z, -400.0, 2.0);
  EXPECT_NEAR(norm(seen.normal + Vec3d{0, 0, -seen.normal.z}), 0.0, 1.0);
  EXPECT_GT(map.in_the_way(Comm()).directions, seen.directions);
}

TEST(SightMap, SeesTheNearestTriangleAndMeasuresTheSky) {
  SightMap map({0, 0, 0}, 50.0);
  const auto square = [&](double z, double half, std::uint32_t number) {
    map.add_triangle({-half, -half, z}, {half, -half, z}, {half, half, z}, number);
    map.add_triangle({-half, -half, z}, {half, half, z}, {-half, half, z}, number + 1);
  };
  square(10.0, 10.0, 0);  // a side of the cube of directions: a sixth of the sky
  square(20.0, 5.0, 2);   // behind it
  square(5.0, 1.0, 4);    // before it
  square(60.0, 60.0, 6);  // out of reach
  map.join(Comm());
  EXPECT_EQ(map.seen(), (std::vector<std::uint32_t>{0, 1, 4, 5}));
  EXPECT_NEAR(map.covered(), 1.0 / 6.0, 2e-3);

  SightMap ball({0, 0, 0}, 50.0);
  ball.add_ball({0, 20, 0}, 10.0);  // a cone of 30 degrees: (1 − cos 30°)/2 of the sky
  ball.join(Comm());
  EXPECT_NEAR(ball.covered(), 0.5 * (1.0 - std::sqrt(0.75)), 1e-3);
  EXPECT_TRUE(ball.seen().empty());
  // Between the eye and the ball: the cone that touches it, without the cap that reaches into the cone.
  const double side = std::sqrt(20.0 * 20.0 - 10.0 * 10.0), height = side * side / 20.0, base = side * 10.0 / 20.0, cap = height - 10.0;
  const double between = std::numbers::pi * (base * base * height - cap * cap * (30.0 - cap)) / 3.0;
  EXPECT_NEAR(ball.in_the_way(Comm()).volume / between, 1.0, 1e-2);
  EXPECT_NEAR(ball.in_the_way(Comm()).directions, ball.covered(), 1e-12);
  ball.add_triangle({-30, 5, -30}, {30, 5, -30}, {0, 5, 60}, 0);  // before the ball
  ball.join(Comm());
  EXPECT_EQ(ball.in_the_way(Comm()).volume, 0.0);
}

/// A cavity that is kept open by its fluid: it grows under pressure, and steps stay sound.
TEST(Lumen, GrowsUnderPressureAndKeepsItsMarksInARun) {
  Model model = test::clusters_model(0.2);
  model.mark_names = {"cavity"};
  Lumen lumen;
  lumen.name = "cavity";
  lumen.renewed = 50.0;
  lumen.pressure = 0.02;
  model.types[0].shell.tension = 0.3;
  model.step.max_step = 10.0;
  model.contact.range = 1.2;
  double volume[2];
  for (const bool pressed : {false, true}) {
    lumen.pressure = pressed ? 0.02 : 0.0;
    model.lumens = {lumen};
    ShapeLibrary shapes;
    std::vector<Vec3d> center = walls();
    for (Vec3d& c : center) c *= 11.2 / kDistance;  // neighbours 11.8 µm apart
    Tissue tissue = test::make_tissue(model, shapes, center, std::vector(12, BodyKind::kShell), 42);
    auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
    while (simulation->tissue().clock.time < 100.0) ASSERT_TRUE(simulation->step(100.0).ok());
    volume[pressed] = simulation->tissue().lumens[0].volume;
    EXPECT_GT(simulation->tissue().lumens[0].covered, 0.5);
    EXPECT_GT(simulation->tissue().lumens[0].looked_at, 0.0);
  }
  EXPECT_GT(volume[1], 1.01 * volume[0]);
}

}  // namespace
}  // namespace morula
