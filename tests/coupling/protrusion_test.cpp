#include "coupling/protrusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/mesh/primitives.h"
#include "core/random/philox.h"
#include "coupling/behaviours/polarity.h"
#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

CellType turning(double rate, double follow = 0.0) {
  CellType type;
  type.polarity.set = true;
  OwnValues values;
  values.set("turning", rate);
  values.set("follow_velocity", follow);
  for (const auto& rule : polarity_rules()) type.polarity.add(rule, values);
  return type;
}

Vec3d turned(const Vec3d& polarity, const Vec3d& velocity, CellId id, const CellType& type, std::uint32_t seed, std::uint64_t step,
             double dt) {
  return next_polarity(polarity, {.id = id, .velocity = velocity, .random = Random(seed, RandomStream::kPolarity), .step = step, .dt = dt},
                       type);
}

/// dp/dt = (v − (v·p) p)/τ for p of length 1: from a right angle the part of p across v falls as 1/cosh(t/τ), whatever the steps.
TEST(Polarity, FollowsTheVelocityExactlyInStepsOfAnyLength) {
  const CellType type = turning(0.0, 60.0);
  for (const auto& [dt, steps] : {std::pair{90.0, 1}, {9.0, 10}, {0.5, 180}}) {
    Vec3d p{0, 1, 0};
    for (int step = 0; step < steps; ++step) p = turned(p, {2.0, 0, 0}, CellId::founder(1), type, 7, static_cast<std::uint64_t>(step), dt);
    EXPECT_NEAR(p.y, 1.0 / std::cosh(1.5), 1e-12) << dt;
    EXPECT_NEAR(p.x, std::tanh(1.5), 1e-12) << dt;
  }
  // Backwards: it turns within some times τ, in short steps, too.
  for (const double dt : {600.0, 6.0}) {
    Vec3d p{-1, 0, 0};
    for (double time = 0.0; time < 600.0; time += dt) p = turned(p, {2.0, 0, 0}, CellId::founder(1), type, 7, 0, dt);
    EXPECT_NEAR(norm(p), 1.0, 1e-12);
    EXPECT_GT(p.x, 0.9) << dt;
  }
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
      for (int step = 0; step < steps; ++step) p = turned(p, {}, cell, type, 7, static_cast<std::uint64_t>(step), dt);
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
  for (int k = 0; k < 300; ++k) p = turned(p, {0, 2.0, 0}, CellId::founder(1), type, 1, static_cast<std::uint64_t>(k), 2.0);
  EXPECT_GT(p.y, 0.999);
  CellType none;
  EXPECT_EQ(turned({}, {1, 0, 0}, CellId::founder(1), none, 1, 0, 1.0), Vec3d{});
  CellType given = turning(0.0);
  given.polarity.start = {0, 0, 1};
  EXPECT_EQ(initial_polarity(CellId::founder(3), given, 1), (Vec3d{0, 0, 1}));
}

Vec3d sum_of(const std::vector<Vec3d>& force) {
  Vec3d out{};
  for (const Vec3d& f : force) out += f;
  return out;
}

Protrusion pushing(double force, double angle) {
  Protrusion law;
  law.force = force;
  law.angle = angle;
  return law;
}

TEST(Protrusion, IsBorneByTheFrontAndAnInternalOneHasNoSum) {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(642).value();
  Protrusion law = pushing(2.0, 0.7);
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
  EXPECT_FALSE(add_protrusion(law, *shape->topology, shape->position, p, {nowhere, {0, 0, 1}}, p, law.force, force));
}

/// A round cell touches what it lies on with a small cap, all of which is far from its polarity: the part of the cap that lies ahead is the front.
TEST(Protrusion, OfARoundCellIsBorneByTheFrontOfItsContact) {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(642).value();
  Protrusion law = pushing(2.0, 0.7);
  std::vector<char> touches(642, 0);
  for (std::size_t i = 0; i < touches.size(); ++i) touches[i] = normalized(shape->position[i]).z < -0.9;
  const Vec3d ahead = normalized(Vec3d{1, 2, 0});
  std::vector<Vec3d> force(642);
  ASSERT_TRUE(
      add_protrusion(law, *shape->topology, shape->position, ahead + Vec3d{0, 0, 0.4}, {touches, {0, 0, 1}}, ahead, law.force, force));
  EXPECT_NEAR(norm(sum_of(force) - ahead * 2.0), 0.0, 1e-12);
  for (std::size_t i = 0; i < force.size(); ++i) {
    const Vec3d x = shape->position[i];
    const bool is_ahead = dot(Vec3d{x.x, x.y, 0}, ahead) > std::cos(0.7) * std::hypot(x.x, x.y) + 1e-12;
    EXPECT_EQ(norm2(force[i]) > 0.0, touches[i] != 0 && is_ahead) << i;
  }
}

/// T11.2: ΣF = 0 of an internal reaction, whatever the shape, so that V = ΣF/(γ A) < 1e-10 F_p/Γ in a uniform medium; T11.3: F_p with it
/// outside. T11.4: a mesh that is turned with the polarity is pushed in the same way, and whatever the polarity is to the mesh the push
/// has no other direction.
TEST(Protrusion, IsTheSameInAllDirectionsOfARoughCell) {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(162).value();
  const Random random(3, RandomStream::kInitialPosition);
  std::uint64_t draw = 0;
  std::vector<Vec3d> x;
  for (const Vec3d& place : shape->position)
    x.push_back(Vec3d{1.2 * place.x, place.y, 0.8 * place.z} * 9.0 + random.direction(CellId(1), draw++) * 0.3);
  Protrusion law = pushing(2.0, 0.7);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3d p = random.direction(CellId(2), draw++), axis = random.direction(CellId(3), draw++);
    const auto turn = [&](const Vec3d& v) {  // by 1 rad about the axis
      return v * std::cos(1.0) + cross(axis, v) * std::sin(1.0) + axis * (dot(axis, v) * (1.0 - std::cos(1.0)));
    };
    std::vector<Vec3d> turned;
    for (const Vec3d& v : x) turned.push_back(turn(v) + Vec3d{5, -3, 8});
    for (const bool internal : {false, true}) {
      law.internal = internal;
      std::vector<Vec3d> here(x.size()), there(x.size());
      ASSERT_TRUE(add_protrusion(law, *shape->topology, x, p, {}, p, law.force, here));
      ASSERT_TRUE(add_protrusion(law, *shape->topology, turned, turn(p), {}, turn(p), law.force, there));
      for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LT(norm(there[i] - turn(here[i])), 1e-12 * law.force);
      EXPECT_LT(norm(sum_of(here) - (internal ? Vec3d{} : p * law.force)), 1e-10 * law.force);
    }
  }
}

/// T11.4: the front that carries the force is a round cap about the polarity on a fine mesh, so that it turns the cell by no more than the
/// mesh makes it, and on average over all directions not at all.
TEST(Protrusion, HasNoPreferredDirectionOnTheMesh) {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(642).value();
  std::vector<Vec3d> x;
  for (const Vec3d& place : shape->position) x.push_back(normalized(place) * 6.0);
  Protrusion law;
  law.force = 1.0;
  const Random random(4, RandomStream::kInitialPosition);
  constexpr int kTrials = 400;
  Vec3d mean;
  double square = 0.0, largest = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vec3d p = random.direction(CellId(2), static_cast<std::uint64_t>(trial));
    std::vector<Vec3d> force(x.size());
    ASSERT_TRUE(add_protrusion(law, *shape->topology, x, p, {}, p, law.force, force));
    Vec3d lever;  // of the front, over the radius; along p but for the mesh
    for (std::size_t i = 0; i < x.size(); ++i) lever += x[i] * (dot(force[i], p) / 6.0);
    const Vec3d aside = lever - p * dot(lever, p);
    mean += aside * (1.0 / kTrials);
    square += norm2(aside) / kTrials;
    largest = std::max(largest, norm(aside));
  }
  EXPECT_LT(largest, 0.005);
  EXPECT_LT(norm(mean), 3.0 * std::sqrt(square / kTrials));
}

Model protruding(bool internal) {
  Model model = test::clusters_model();
  model.types[0].polarity.set = true;
  model.types[0].protrusion.force = 0.2;
  model.types[0].protrusion.internal = internal;
  model.types[0].shell.spring_stiffness = 2.0;
  model.step.first_tolerance = model.step.later_tolerance = 1e-7;
  model.step.newton_stop = 1e-11;
  model.step.max_newton = 50;
  model.step.max_step = 5.0;
  return model;
}

/// T11.2 and T11.3: with the reaction outside V = F_p/(γ A); with it inside a uniform medium does not carry the cell anywhere, |V| < 1e-10
/// F_p/Γ.
TEST(Protrusion, MovesAFreeCellOnlyWithItsReactionOutside) {
  ShapeLibrary shapes;
  for (const bool internal : {false, true}) {
    const Model model = protruding(internal);
    Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 162);
    tissue.cells.optional.polarity.set(0, {1, 0, 0});
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
    EXPECT_NEAR(moved, expected, 1e-10 * scale);
    EXPECT_GT(scale, 0.2);
  }
}

/// T11.3: V = F_p/(γ_ECM A + γ_sub A_c), A_c the area of contact with its taper at the rim. A cell between two plates, which it touches
/// alike, slides and does not roll.
TEST(Protrusion, MovesACellOnASubstrateAgainstBothFrictions) {
  constexpr double kSubstrate = 5.0;
  Model model = protruding(false);
  model.types[0].protrusion.force = 0.1;
  model.contact.range = 0.5;
  model.contact.repulsion = 100.0;
  TriangleMesh lower = make_box({60, 60, 4}, 20.0).value(), upper = lower;
  for (Vec3d& x : lower.position) x.z -= 7.6;
  for (Vec3d& x : upper.position) x.z += 7.6;
  model.obstacles = {{"lower", lower.position, lower.faces, false, {}, {}, {}}, {"upper", upper.position, upper.faces, false, {}, {}, {}}};
  model.pairs.assign(9, ContactPair{0.02, kSubstrate, kSubstrate});
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 162);
  tissue.obstacle_offset.resize(2);
  tissue.cells.optional.polarity.set(0, {1, 0, 0});
  auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
  const auto to = [&](double time) {
    while (simulation->tissue().clock.time < time) ASSERT_TRUE(simulation->step(time).ok());
  };
  to(600.0);
  const std::vector<Vec3d> before = simulation->tissue().shells.position;
  double area = 0.0, contact = 0.0;
  int count = 0;
  for (double time = 650.0; time <= 900.0; time += 50.0, ++count) {
    to(time);
    Mechanics& mechanics = simulation->mechanics();
    area += mechanics.values(simulation->tissue()).area[0];
    for (const std::vector<char>& plate : {std::vector<char>{0, 1, 0}, std::vector<char>{0, 0, 1}})
      contact += mechanics.touch_of_bodies(simulation->tissue(), plate)[0].area;
  }
  area /= count, contact /= count;
  Vec3d way;
  double most = 0.0, least = 1e300;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Vec3d d = simulation->tissue().shells.position[i] - before[i];
    way += d * (1.0 / static_cast<double>(before.size()));
    most = std::max(most, d.x), least = std::min(least, d.x);
  }
  const double expected = 0.1 / (0.1 * area + kSubstrate * contact);
  EXPECT_GT(contact, 10.0);
  EXPECT_NEAR(way.x / 300.0 / expected, 1.0, 1e-3);
}

}  // namespace
}  // namespace morula
