/// Spheres on obstacles: every part that faces them bears them, a smooth part once (decision 0023).
#include <gtest/gtest.h>

#include <cmath>

#include "core/contact/rigid_surface.h"
#include "core/mesh/primitives.h"
#include "core/random/philox.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kRadius = 6.0;
constexpr double kModulus = 0.45 / (1.0 - 0.4 * 0.4);  // of the spheres against something rigid

/// Overlap at which Hertz's force (4/3) E* √R δ^1.5 on a plane is this [µm].
double hertz_overlap(double force) { return std::pow(3.0 * force / (4.0 * kModulus * std::sqrt(kRadius)), 2.0 / 3.0); }

Model model_with(const TriangleMesh& mesh, bool inside, double adhesion = 0.0) {
  Model model = test::clusters_model(0.0);
  const ContactPair cells = model.pairs[0], wall{adhesion, 0.1, 0.1};
  model.obstacles = {ObstacleSpec{"obstacle", mesh.position, mesh.faces, inside, {}}};
  model.pairs = {cells, wall, wall, wall};
  return model;
}

struct Pushed {
  Vec3d at;
  Vec3d on_obstacle;
  double area = 0.0, pressure = 0.0;
};

/// Where a sphere comes to rest under a force.
Pushed push(const Model& model, const Vec3d& from, const Vec3d& force) {
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {from}, {BodyKind::kSphere}, 162, kRadius);
  tissue.obstacle_offset.resize(1);
  Mechanics mechanics(model, contact_obstacles(model).value(), shapes, Comm(), 1);
  const std::vector<Vec3d> external{force};
  double dt = 1.0;
  for (int k = 0; k < 200; ++k) {
    if (!mechanics.step(tissue, dt, external).ok()) {
      dt *= 0.5;
      continue;
    }
    tissue.clock.time += dt;
    dt = std::min(60.0, 1.3 * dt);
  }
  const BodyValues values = mechanics.values(tissue);
  return {tissue.spheres.position[0], mechanics.obstacle_forces(tissue)[0], values.contact_area[0], values.pressure[0]};
}

TEST(SphereObstacle, EachWallOfACornerBearsItsOwnForce) {
  const TriangleMesh box = make_box({60, 60, 60}, 7.0).value();  // cells are inside; many faces a wall
  const Model model = model_with(box, true);
  const Vec3d force{0.3, 0.2, 0.0};
  const Pushed end = push(model, {23.5, 23.6, 0.3}, force);
  // Hertz: 0.308 and 0.235 µm. Steps end within 1e-3 of the way.
  EXPECT_NEAR(end.at.x - (30.0 - kRadius), hertz_overlap(0.3), 2e-3);
  EXPECT_NEAR(end.at.y - (30.0 - kRadius), hertz_overlap(0.2), 2e-3);
  EXPECT_NEAR(hertz_overlap(0.3), 0.308, 1e-3);
  EXPECT_NEAR(hertz_overlap(0.2), 0.235, 1e-3);
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(end.on_obstacle[axis], force[axis], 2e-3);
  EXPECT_NEAR(end.area, std::numbers::pi * kRadius * (hertz_overlap(0.3) + hertz_overlap(0.2)), 0.1);  // πRδ each
  // Both walls press: p = Σ F (R − δ)/(3 V), V less than the ball by 4e-4 of it.
  const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 3);
  const double virial = 0.3 * (kRadius - hertz_overlap(0.3)) + 0.2 * (kRadius - hertz_overlap(0.2));
  EXPECT_NEAR(end.pressure / (virial / (3.0 * ball)), 1.0, 0.01);
}

TEST(SphereObstacle, AWallOfManyFacesCountsOnce) {
  for (const double edge : {30.0, 2.0}) {
    const Pushed end = push(model_with(make_box({60, 60, 60}, edge).value(), true), {0.3, 23.6, 0.2}, {0.0, 0.3, 0.0});
    EXPECT_NEAR(end.at.y - (30.0 - kRadius), hertz_overlap(0.3), 2e-3) << edge;
  }
}

TEST(SphereObstacle, ASmoothMouldCountsOnce) {
  const TriangleMesh bowl = make_sphere(8.0, 4).value();  // 5,120 faces: each turns by 3°
  const Pushed end = push(model_with(bowl, true), {0.0, 0.0, -1.9}, {0.0, 0.0, -0.3});
  // So narrow a mould bears a sphere as a plane bears one of twice its radius, δ ∝ R*^(−1/3); the mesh lies up to 2e-3 R within the sphere of its nodes.
  EXPECT_NEAR(-end.at.z - (8.0 - kRadius), hertz_overlap(0.3) / std::cbrt(2.0), 0.02);
  EXPECT_NEAR(norm(end.on_obstacle), 0.3, 0.01);  // the nearest of faces changes at rest: the last steps are short
}

/// From a wall round a convex edge to the other: energy and force go on without a step, and an edge counts once.
TEST(SphereObstacle, ForcesGoRoundAConvexEdgeWithoutAStep) {
  const TriangleMesh box = make_box({20, 20, 20}, 20.0).value();
  const Model model = model_with(box, false);
  ShapeLibrary shapes;
  double last_energy = -1.0;
  Vec3d last_force;
  for (int k = 0; k <= 200; ++k) {
    const double angle = (k - 50) * 0.5 * std::numbers::pi / 100.0;  // within the edge's cone from 50 to 150
    const double clamped = std::clamp(angle, 0.0, 0.5 * std::numbers::pi), beyond = angle - clamped;
    const Vec3d out{std::sin(clamped), std::cos(clamped), 0.0};
    const Vec3d slide = beyond < 0.0 ? Vec3d{beyond * 5.0, 0, 0} : Vec3d{0, -beyond * 5.0, 0};
    Tissue tissue = test::make_tissue(model, shapes, {Vec3d{10, 10, 1.3} + slide + out * 5.7}, {BodyKind::kSphere}, 162, kRadius);
    tissue.obstacle_offset.resize(1);
    Mechanics mechanics(model, contact_obstacles(model).value(), shapes, Comm(), 1);
    std::vector<Vec3d> force;
    const double energy = mechanics.energy_and_forces(tissue, force);
    EXPECT_NEAR(norm(force[0]), 4.0 / 3.0 * kModulus * std::sqrt(kRadius) * std::pow(0.3, 1.5), 1e-9) << k;
    EXPECT_GT(dot(force[0], out), 0.999999 * norm(force[0])) << k;
    if (k > 0) {
      EXPECT_NEAR(energy, last_energy, 1e-12);
      EXPECT_LT(norm(force[0] - last_force), 0.02 * norm(force[0]));
    }
    last_energy = energy;
    last_force = force[0];
  }
}

TEST(SphereObstacle, APlateThinnerThanTheSphereBearsItFromOneSideOnly) {
  const TriangleMesh plate = make_box({60, 60, 1}, 10.0).value();
  const Pushed end = push(model_with(plate, false), {0.3, 0.2, 6.45}, {0.0, 0.0, -0.3});
  EXPECT_NEAR(0.5 + kRadius - end.at.z, hertz_overlap(0.3), 2e-3);
}

TEST(SphereObstacle, AdheresToACornerAsToOneObstacle) {
  const TriangleMesh box = make_box({60, 60, 60}, 7.0).value();
  const Model model = model_with(box, true, 0.05);
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{24.1, 24.05, 0.3}}, {BodyKind::kSphere}, 162, kRadius);
  tissue.obstacle_offset.resize(1);
  Mechanics mechanics(model, contact_obstacles(model).value(), shapes, Comm(), 1);
  const std::vector<Vec3d> none(1);
  for (int k = 0; k < 60; ++k) {
    const double dt = k < 20 ? 0.2 : 2.0;
    ASSERT_TRUE(mechanics.step(tissue, dt, none).ok()) << k;
    tissue.clock.time += dt;
    ASSERT_EQ(tissue.spheres.attached[0].size(), 1u);
    Mechanics fresh(model, contact_obstacles(model).value(), shapes, Comm(), 1);  // what a restart would see
    ASSERT_EQ(fresh.values(tissue).pressure, mechanics.values(tissue).pressure) << k;
  }
  EXPECT_GT(tissue.spheres.position[0].x, 24.1);
  EXPECT_NEAR(tissue.spheres.position[0].x, tissue.spheres.position[0].y, 1e-2);  // the same rest at both walls
}

/// The faces of a mould stand for a ball: it is met where that is, towards its middle, from anywhere within (decision 0087). The faces turn by 5° from one to
/// the next, and lie up to 0.03 µm within it.
TEST(SphereObstacle, SeesTheSmoothSurfaceThatTheFacesOfAMouldStandFor) {
  const auto surfaces = contact_obstacles(model_with(make_sphere(20.0, 3).value(), true)).value();
  const Random random(5, RandomStream::kInitialPosition);
  for (std::uint64_t k = 0; k < 300; ++k) {
    const Vec3d out = random.direction(CellId(1), k), p = out * 14.0;
    const auto foot = foot_on_part(surfaces[0], 0, p, 10.0);
    ASSERT_TRUE(foot.has_value());
    EXPECT_LT(norm(foot->normal + out), 2e-3) << k;
    EXPECT_NEAR(foot->distance - foot->bulge, 6.0, 1e-3) << k;
  }
}

}  // namespace
}  // namespace morula
