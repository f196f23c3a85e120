#include "coupling/loads/loads.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kRadius = 6.0;

std::shared_ptr<const ReferenceShape> icosphere(std::uint32_t nodes) {
  static ShapeLibrary shapes;
  return shapes.icosphere(nodes).value();
}

/// Nodes on a ball that encloses the volume of a sphere of radius 6, its centre anywhere.
std::vector<Vec3d> ball(const ReferenceShape& shape, const Vec3d& center = {3, -2, 7}) {
  std::vector<Vec3d> out;
  for (const Vec3d& p : shape.position) out.push_back(center + p * std::cbrt(4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius));
  return out;
}

std::vector<Vec3d> forces(const CellLoad& load, std::uint32_t nodes, double strength = 1.0) {
  const auto shape = icosphere(nodes);
  std::vector<Vec3d> out(nodes);
  add_shell_load(load, *shape, ball(*shape), {}, strength, out);
  return out;
}

Vec3d sum(const std::vector<Vec3d>& force) {
  Vec3d out{};
  for (const Vec3d& f : force) out += f;
  return out;
}

/// Σ f · x from the cell's centre: what a load does to the size.
double virial(const std::vector<Vec3d>& force, std::uint32_t nodes) {
  const auto x = ball(*icosphere(nodes), {});
  double out = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) out += dot(force[i], x[i]);
  return out;
}

TEST(TimeCourse, IsStraightBetweenItsPointsAndConstantOutside) {
  const TimeCourse course{{10.0, 20.0, 50.0}, {0.0, 1.0, -0.5}};
  EXPECT_EQ(course.at(0.0), 0.0);
  EXPECT_DOUBLE_EQ(course.at(15.0), 0.5);
  EXPECT_EQ(course.at(20.0), 1.0);
  EXPECT_DOUBLE_EQ(course.at(40.0), 0.0);
  EXPECT_EQ(course.at(1e9), -0.5);
  EXPECT_EQ(course.next_point(9.0), 10.0);
  EXPECT_EQ(course.next_point(10.0), 20.0);
  EXPECT_EQ(course.next_point(50.0), kNever);
  EXPECT_EQ(TimeCourse{}.at(3.0), 1.0);
}

TEST(EndNodes, AreTheWantedPartWithTiesAndLieOppositeEachOther) {
  for (const std::uint32_t nodes : {162u, 642u}) {
    const auto shape = icosphere(nodes);
    const auto high = end_nodes(*shape, {1, 0, 0}, 0.02), low = end_nodes(*shape, {-1, 0, 0}, 0.02);
    EXPECT_EQ(high.size(), low.size());
    EXPECT_GE(high.size(), static_cast<std::size_t>(std::llround(0.02 * nodes)));
    EXPECT_LE(high.size(), static_cast<std::size_t>(std::llround(0.02 * nodes)) + 4);  // a node and its mirror images
    double least = 1e300;
    for (const std::uint32_t i : high) least = std::min(least, shape->position[i].x);
    for (std::uint32_t i = 0; i < nodes; ++i)
      EXPECT_TRUE(shape->position[i].x <= least + 1e-9 || std::binary_search(high.begin(), high.end(), i));
  }
  EXPECT_EQ(end_nodes(*icosphere(162), {0, 0, 1}, 1.0).size(), 162u);
}

TEST(Load, TractionStretchesASphereWithoutMovingIt) {  // ∮ s0 cos²θ n · x dA = s0 R A/3 = 4π s0 R³/3
  CellLoad load;
  load.what = traction_load();
  load.size = 2e-3;
  load.axis = normalized(Vec3d{1, 2, -1});
  for (const auto& [nodes, tolerance] : {std::pair{162u, 0.02}, {642u, 0.005}}) {
    const auto f = forces(load, nodes, 0.5);
    EXPECT_LT(norm(sum(f)), 1e-12);
    const double expected = 0.5 * load.size * 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;
    EXPECT_NEAR(virial(f, nodes) / expected, 1.0, tolerance) << nodes;  // faces of finite size: first order in their area
  }
}

TEST(Load, PullIsTheWholeForceAtEachEnd) {
  CellLoad load;
  load.what = pull_load();
  load.size = 0.193;
  load.part = 0.02;
  const auto f = forces(load, 642);
  EXPECT_LT(norm(sum(f)), 1e-15);
  double high = 0.0;
  for (const Vec3d& force : f) high += std::max(0.0, force.x);
  EXPECT_NEAR(high, 0.193, 1e-15);
  load.end = LoadEnd::kLow;
  EXPECT_NEAR(sum(forces(load, 642)).x, -0.193, 1e-15);
}

TEST(Load, PressureIsThatOfTheVolume) {  // Σ f · x = −p ∮ n · x dA = −3 p V exactly, whatever the mesh
  CellLoad load;
  load.what = pressure_load();
  load.size = 0.01;
  const auto f = forces(load, 162);
  EXPECT_LT(norm(sum(f)), 1e-13);
  EXPECT_NEAR(virial(f, 162), -3.0 * 0.01 * 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius, 1e-10);
}

TEST(Load, PressureOnACapIsThatOfItsProjection) {  // ∫ over a cap of n dA is its flat base: along the axis, π a²
  CellLoad load;
  load.what = pressure_load();
  load.size = -0.01;  // suction
  load.part = 0.25;
  load.end = LoadEnd::kHigh;
  load.axis = {0, 0, 1};
  const Vec3d total = sum(forces(load, 2562));
  // A quarter of the nodes is a quarter of the surface: (1 − cos φ)/2 = 1/4, a = R sin φ = R √3/2; faces cut by the rim are left out.
  EXPECT_NEAR(total.z / (0.01 * std::numbers::pi * 0.75 * kRadius * kRadius), 1.0, 0.06);
  EXPECT_LT(std::abs(total.x) + std::abs(total.y), 1e-3 * total.z);
}

/// A load on the upper half of the faces, marked with bit 2, of a ball of 642 nodes.
struct MarkedBall {
  std::shared_ptr<const ReferenceShape> shape = icosphere(642);
  std::vector<Vec3d> x = ball(*shape);
  std::vector<std::uint8_t> marks;
  double area = 0.0;
  Vec3d area_vector{};

  MarkedBall() {
    for (const Triangle& t : shape->topology->faces()) {
      const bool upper = shape->position[t[0]].z + shape->position[t[1]].z + shape->position[t[2]].z > 0.0;
      marks.push_back(upper ? 0b101 : 0b001);
      const Vec3d face = cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]) * 0.5;
      if (upper) area += norm(face), area_vector += face;
    }
  }

  [[nodiscard]] std::vector<Vec3d> forces(CellLoad load) const {
    load.mark = 2;
    std::vector<Vec3d> out(x.size());
    add_shell_load(load, *shape, x, {marks, marks.size()}, 1.0, out);
    return out;
  }
};

TEST(Load, PatchIsItsForceOnOneSideDownToANode) {
  CellLoad load;
  load.what = patch_load();
  load.force = {0.1, -0.2, 0.3};
  load.axis = {0, 0, 1};
  load.end = LoadEnd::kHigh;
  load.part = 0.1;
  const auto shape = icosphere(642);
  const auto loaded = end_nodes(*shape, load.axis, load.part);
  const auto f = forces(load, 642, 2.0);
  EXPECT_LT(norm(sum(f) - load.force * 2.0), 1e-15);
  for (std::uint32_t i = 0; i < 642; ++i) EXPECT_EQ(norm(f[i]) > 0.0, std::binary_search(loaded.begin(), loaded.end(), i)) << i;

  load.part = 1e-6;
  load.axis = normalized(shape->position[17]);  // a direction that one node lies in, without mirror images about it
  const auto point = forces(load, 642);
  EXPECT_EQ(point[17], load.force);
  EXPECT_EQ(sum(point), load.force);
}

TEST(Load, PatchOnMarkedFacesIsSharedByArea) {
  CellLoad load;
  load.what = patch_load();
  load.force = {0.1, -0.2, 0.3};
  const MarkedBall cell;
  const auto f = cell.forces(load);
  EXPECT_LT(norm(sum(f) - load.force), 1e-14);
  // A node deep in the patch bears a third of the areas of its faces, of the whole.
  std::vector<double> share(642);
  for (std::size_t k = 0; k < cell.marks.size(); ++k) {
    const Triangle& t = cell.shape->topology->faces()[k];
    const double area = 0.5 * norm(cross(cell.x[t[1]] - cell.x[t[0]], cell.x[t[2]] - cell.x[t[0]]));
    for (int corner = 0; corner < 3; ++corner) share[t[corner]] += (cell.marks[k] >> 2 & 1) * area / (3.0 * cell.area);
  }
  for (std::size_t i = 0; i < 642; ++i) EXPECT_LT(norm(f[i] - load.force * share[i]), 1e-15) << i;

  std::vector<Vec3d> none(642);
  load.mark = 3;  // no face has it: no force, and no division by an area of nothing
  add_shell_load(load, *cell.shape, cell.x, {cell.marks, cell.marks.size()}, 1.0, none);
  add_shell_load(load, *cell.shape, cell.x, {}, 1.0, none);
  EXPECT_EQ(none, std::vector<Vec3d>(642));
}

TEST(Load, PressureOnMarkedFacesIsThatOfTheirAreaVector) {
  CellLoad load;
  load.what = pressure_load();
  load.size = 0.02;
  const MarkedBall cell;
  EXPECT_LT(norm(sum(cell.forces(load)) + cell.area_vector * 0.02), 1e-13);
}

/// −∮ (g·x) n dA = −g V (Archimedes), whatever the mesh: p is linear and its mean over a face is that at its middle.
TEST(Load, PressureWithAGradientIsTheBuoyancyOfTheVolume) {
  CellLoad load;
  load.what = pressure_load();
  load.size = 5.0;
  load.gradient = {1e-3, 0.0, -2e-3};
  load.origin = {3, -2, 7};
  const double volume = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;
  for (const std::uint32_t nodes : {42u, 162u}) EXPECT_LT(norm(sum(forces(load, nodes)) + load.gradient * volume), 1e-11) << nodes;
  // At the centre the pressure is `size`: the virial about it is that of a uniform pressure, as the gradient is odd there.
  EXPECT_NEAR(virial(forces(load, 162), 162), -3.0 * 5.0 * volume, 1e-8);
}

/// What a step needs of a load that follows the surface: its force is the gradient of its energy, also on a shape without any symmetry. The energy
/// of a uniform pressure is p V; that of a gradient is g·∫(x − x0) dV, on a ball V g·(c − x0).
TEST(Load, PressureOnAWholeCellIsTheGradientOfItsEnergy) {
  CellLoad load;
  load.what = pressure_load();
  load.size = 0.05;
  load.gradient = {1e-3, 0.0, -2e-3};
  load.origin = {1, 0, 2};
  ASSERT_TRUE(follows_surface(load));
  const auto shape = icosphere(42);
  std::vector<Vec3d> x = ball(*shape);
  const auto energy = [&] { return load.what->energy(load, {*shape, x, {}, 0.7}); };
  const double volume = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;
  EXPECT_NEAR(energy(), 0.7 * volume * (0.05 + dot(load.gradient, Vec3d{3, -2, 7} - load.origin)), 1e-9);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto k = static_cast<double>(i);
    x[i] += {0.3 * std::sin(3.0 * k), 0.2 * std::cos(5.0 * k), 0.1 * std::sin(7.0 * k)};
  }
  std::vector<Vec3d> force(x.size());
  add_shell_load(load, *shape, x, {}, 0.7, force);
  constexpr double kStep = 1e-4;
  for (std::size_t i = 0; i < x.size(); i += 5)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double here = x[i][axis];
      x[i][axis] = here + kStep;
      const double above = energy();
      x[i][axis] = here - kStep;
      const double slope = (above - energy()) / (2.0 * kStep);
      x[i][axis] = here;
      EXPECT_NEAR(force[i][axis], -slope, 1e-8) << i;
    }
  load.part = 0.5;
  EXPECT_FALSE(follows_surface(load));
}

/// T9.2 of dcm.md: a force F on a cell moves it with V = F/(γ_ECM A), A the area of the mesh: 45.023 nN·s/µm at 642 nodes on R = 6, γ = 0.1.
TEST(Load, BodyForceMovesAFreeCellWithTheSpeedOfItsDrag) {
  Model model = test::clusters_model();
  model.types[0].shell.medium_friction = 0.1;
  model.step.first_tolerance = 1e-6;
  model.step.newton_stop = 1e-3;
  CellLoad load;
  load.force = {0.6, 0, 0.8};
  load.course = {{0.0, 10.0, 20.0}, {1.0, 1.0, 3.0}};
  model.loads = {load};
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 642);
  // the published area is that of a mesh with its nodes on the sphere; this one encloses the sphere's volume
  const double scale = std::pow(0.99139, -2.0 / 3.0);
  auto made = Simulation::create(model, std::move(tissue), Comm(), 1);
  ASSERT_TRUE(made.ok());
  Simulation& simulation = **made;
  const auto mean = [&] {
    Vec3d out{};
    for (const Vec3d& x : simulation.tissue().shells.position) out += x * (1.0 / 642.0);
    return out;
  };
  while (simulation.tissue().clock.time < 10.0) ASSERT_TRUE(simulation.step(10.0).ok());
  const Vec3d v = mean() * 0.1;
  EXPECT_NEAR(norm(v) * 45.023 * scale, 1.0, 2e-3);  // the force grows with the area of a node, as the friction: no change of shape
  EXPECT_NEAR(v.x / v.z, 0.75, 1e-3);
  EXPECT_EQ(simulation.tissue().clock.time, 10.0);
}

TEST(Load, OnSpheresIsItsForce) {
  Model model = test::clusters_model();
  CellLoad load;
  load.force = {0, 0, -2};
  model.loads = {load};
  ShapeLibrary shapes;
  const Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {50, 0, 0}}, {BodyKind::kShell, BodyKind::kSphere});
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  const Vec3d force = body_force(model, 0, 0.0);
  std::vector<Vec3d> external = mechanics.spread(tissue, std::vector{force, force});
  EXPECT_NEAR(external.back().z, -2.0, 1e-15);
  external.pop_back();
  EXPECT_NEAR(sum(external).z, -2.0, 1e-12);
}

TEST(Course, OfAnObstacleIsFollowedToItsCorners) {
  Model model = test::clusters_model();
  ObstacleSpec plate;
  plate.name = "plate";
  plate.position = {{-1, -1, 99}, {1, -1, 99}, {0, 1, 99}, {0, 0, 98}};
  plate.faces = {{0, 1, 2}, {0, 2, 3}, {1, 0, 3}, {2, 1, 3}};
  plate.direction = {0, 0, 1};
  plate.distance = {{0.0, 3.0, 10.0, 11.0}, {0.0, 1.5, 1.5, 1.0}};
  model.obstacles = {plate};
  model.pairs.assign(4, ContactPair{});
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 42);
  auto made = Simulation::create(model, std::move(tissue), Comm(), 1);
  ASSERT_TRUE(made.ok()) << made.error().message;
  Simulation& simulation = **made;
  std::vector<double> corners;
  while (simulation.tissue().clock.time < 20.0) {
    ASSERT_TRUE(simulation.step(20.0).ok());
    const double t = simulation.tissue().clock.time;
    EXPECT_NEAR(simulation.tissue().obstacle_offset[0].z, plate.distance.at(t), 1e-12);
    if (plate.distance.next_point(t - 1e-9) == t) corners.push_back(t);
  }
  EXPECT_EQ(corners, (std::vector<double>{3.0, 10.0, 11.0}));
}

}  // namespace
}  // namespace morula
