#include "coupling/protrusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/behaviours/polarity.h"
#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

CellType turning(double rate, double follow = 0.0) {
  CellType type;
  type.polarity.set = true;
  type.polarity.diffusion = rate;
  type.polarity.follow_velocity = follow;
  return type;
}

TEST(Polarity, ForgetsItsDirectionAsRotationalDiffusionDoes) {  // ⟨p(0)·p(t)⟩ = e^(−2 D t), whatever the steps
  const CellType type = turning(0.01);
  for (const auto& [dt, steps] : {std::pair{40.0, 1}, {10.0, 4}, {0.5, 80}}) {
    double mean = 0.0;
    Vec3d sum{};
    constexpr int kCells = 4000;
    for (int k = 0; k < kCells; ++k) {
      const CellId cell = CellId::founder(static_cast<std::uint64_t>(k) + 1);
      const Vec3d start = initial_polarity(cell, type, 7);
      Vec3d p = start;
      for (int step = 0; step < steps; ++step) p = next_polarity(p, {}, cell, type, 7, static_cast<std::uint64_t>(step), dt);
      EXPECT_NEAR(norm(p), 1.0, 1e-12);
      mean += dot(p, start) / kCells;
      sum += p * (1.0 / kCells);
    }
    EXPECT_NEAR(mean, std::exp(-0.8), 0.025) << dt;  // 3 standard errors
    EXPECT_LT(norm(sum), 0.04) << "T11.4: all directions alike";
  }
}

TEST(Polarity, TurnsToTheVelocityInItsTime) {
  const CellType type = turning(0.0, 60.0);
  Vec3d p{1, 0, 0};
  for (int k = 0; k < 300; ++k) p = next_polarity(p, {0, 2.0, 0}, CellId::founder(1), type, 1, static_cast<std::uint64_t>(k), 2.0);
  EXPECT_GT(p.y, 0.999);
  CellType none;
  EXPECT_EQ(next_polarity({}, {1, 0, 0}, CellId::founder(1), none, 1, 0, 1.0), Vec3d{});
  CellType given = turning(0.0);
  given.start_polarity = {0, 0, 1};
  EXPECT_EQ(initial_polarity(CellId::founder(3), given, 1), (Vec3d{0, 0, 1}));
}

Vec3d sum_of(const std::vector<Vec3d>& force) {
  Vec3d out{};
  for (const Vec3d& f : force) out += f;
  return out;
}

TEST(Protrusion, IsBorneByTheFrontAndAnInternalOneHasNoSum) {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(642).value();
  Protrusion law;
  law.force = 2.0;
  law.angle = 0.7;
  const Vec3d p = normalized(Vec3d{1, 2, 3});
  std::vector<Vec3d> force(642);
  ASSERT_TRUE(add_protrusion(law, *shape->topology, shape->position, p, {}, p, law.force, force));
  EXPECT_NEAR(norm(sum_of(force) - p * 2.0), 0.0, 1e-12);
  for (std::size_t i = 0; i < force.size(); ++i)
    EXPECT_EQ(norm2(force[i]) > 0.0, dot(normalized(shape->position[i]), p) > std::cos(0.7) + 1e-12);
  law.internal = true;
  force.assign(642, {});
  ASSERT_TRUE(add_protrusion(law, *shape->topology, shape->position, p, {}, p, law.force, force));
  EXPECT_LT(norm(sum_of(force)), 1e-13);
  const std::vector<char> nowhere(642, 0);
  EXPECT_FALSE(add_protrusion(law, *shape->topology, shape->position, p, nowhere, p, law.force, force));
}

Model protruding(bool internal) {
  Model model = test::clusters_model();
  model.types[0].polarity.set = true;
  model.types[0].protrusion.force = 0.2;
  model.types[0].protrusion.internal = internal;
  model.types[0].shell.spring_stiffness = 2.0;
  model.step.first_tolerance = model.step.later_tolerance = 1e-7;
  model.step.newton_stop = 1e-5;
  model.step.max_newton = 12;
  model.step.max_step = 5.0;
  return model;
}

/// T11.2 and T11.3: with the reaction outside V = F_p/(γ A); with it inside a uniform medium does not carry the cell anywhere.
TEST(Protrusion, MovesAFreeCellOnlyWithItsReactionOutside) {
  ShapeLibrary shapes;
  for (const bool internal : {false, true}) {
    const Model model = protruding(internal);
    Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 162);
    tissue.cells.side.polarity.set(0, {1, 0, 0});
    auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
    // The centre that friction by area moves is that of the nodes by area: its velocity is ΣF/(γ A) at every instant.
    double moved = 0.0, expected = 0.0, scale = 0.0;
    while (simulation->tissue().clock.time < 60.0) {
      const Tissue before = simulation->tissue();
      std::vector<double> area(162, 0.0);
      for (const Triangle& t : before.shells.topology(0).faces()) {
        const auto& x = before.shells.position;
        const double third = norm(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])) / 6.0;
        for (const std::uint32_t i : t) area[i] += third;
      }
      ASSERT_TRUE(simulation->step(60.0).ok());
      const double dt = simulation->tissue().clock.time - before.clock.time;
      Vec3d way{};
      double whole = 0.0;
      for (std::size_t i = 0; i < 162; ++i)
        way += (simulation->tissue().shells.position[i] - before.shells.position[i]) * area[i], whole += area[i];
      moved += way.x / whole;
      scale += 0.2 * dt / (0.1 * whole);
      if (!internal) expected += 0.2 * dt / (0.1 * whole);
    }
    EXPECT_NEAR(moved, expected, 1e-4 * scale);
    EXPECT_GT(scale, 0.2);
  }
}

}  // namespace
}  // namespace morula
