/// Tissues of spheres: forces, flags and pressures do not depend on threads, nor on when lists were made.
#include <gtest/gtest.h>

#include "cbm/laws/jkr.h"
#include "cbm/pair_forces.h"
#include "core/random/philox.h"
#include "coupling/mechanics/contact_setup.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kStep = 3.0;  // [s]; most spheres go further in it than half the skin: lists are made anew within steps

/// Two types, one of which does not adhere, with frictions of their own; walls below and on the left.
Model two_types() {
  Model model = test::clusters_model(0.05);
  model.types.push_back(model.types[0]);
  model.types[1].name = "smooth";
  model.types[1].sphere = {.young = 1.0, .poisson = 0.3, .law = cbm::hertz_law()};
  model.pairs = {{0.05, 60.0, 50.0}, {0.02, 20.0, 40.0}, {0.02, 20.0, 40.0}, {0.0, 10.0, 0.0}};
  model.space.box = {{-30, -30, -15}, {200, 200, 200}};
  model.space.boundary[0][0] = model.space.boundary[2][0] = BoundaryKind::kWall;
  model.contact.skin = 0.004;  // lists wear out within a step
  model.contact.range = 2.0;   // long steps are allowed
  return model;
}

/// A dense heap of spheres of many sizes with a pair of sisters half a minute old.
Tissue heap() {
  const Random random(3, RandomStream::kInitialPosition);
  std::vector<CellRecord> cells;
  const auto add = [&](CellId id, const Vec3d& center, double radius) {
    CellRecord& cell = cells.emplace_back();
    cell.row.id = id;
    cell.row.type = static_cast<std::uint16_t>(id.bits() % 2);
    cell.row.order = curve_place(center);
    cell.row.target_volume = cell.row.birth_volume = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    cell.sphere = SphereRecord{center, radius, {}, {}};
  };
  std::uint64_t number = 0;
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 4; ++z) {
        const CellId id = CellId::founder(++number);
        const Vec3d shake = random.direction(id, 0);
        add(id, Vec3d{10.6 * x - 25.0, 10.6 * y - 25.0, 10.6 * z - 9.5} + shake * 0.8, 5.5 + 0.6 * shake.x);
      }
  const CellId mother = CellId::founder(1000).daughter(1);
  add(mother.daughter(0), {-20.0, -20.0, 31.0}, 4.8);
  add(mother.daughter(1), {-20.0, -20.0, 33.6}, 4.8);
  Tissue tissue;
  tissue.clock.time = 30.0;
  put_together(tissue, std::move(cells));
  tissue.obstacle_offset.resize(2);
  return tissue;
}

Mechanics mechanics_of(const Model& model, ShapeLibrary& shapes, int threads) {
  return {model, contact_obstacles(model).value(), shapes, Comm(), threads};
}

void expect_equal(const Tissue& a, const Tissue& b, int step) {
  for (std::size_t i = 0; i < a.spheres.size(); ++i) {
    ASSERT_EQ(a.spheres.position[i], b.spheres.position[i]) << step << ' ' << i;
    ASSERT_EQ(a.spheres.velocity[i], b.spheres.velocity[i]) << step << ' ' << i;
    ASSERT_TRUE(std::ranges::equal(a.spheres.attached[i], b.spheres.attached[i])) << step << ' ' << i;
  }
}

/// A pull that changes with time, so that contacts come and go.
std::vector<Vec3d> pull(std::size_t cells, int step) {
  const Random random(9, RandomStream::kInitialPosition);
  std::vector<Vec3d> out;
  for (std::size_t i = 0; i < cells; ++i)
    out.push_back(random.direction(CellId::founder(i + 1), static_cast<std::uint64_t>(step / 6)) * 1.5);
  return out;
}

TEST(SphereContacts, GiveTheSameBitsOnAnyNumberOfThreads) {
  const Model model = two_types();
  ShapeLibrary shapes;
  Tissue one = heap(), three = one;
  Mechanics with_one = mechanics_of(model, shapes, 1), with_three = mechanics_of(model, shapes, 3);
  std::size_t flips = 0, partners = 0;
  for (int step = 0; step < 30; ++step) {
    ASSERT_TRUE(with_one.step(one, kStep, pull(one.cells.size(), step)).ok());
    ASSERT_TRUE(with_three.step(three, kStep, pull(one.cells.size(), step)).ok());
    expect_equal(one, three, step);
    EXPECT_EQ(with_one.pressures(one), with_three.pressures(three));
    std::size_t now = 0;
    for (std::size_t i = 0; i < one.spheres.size(); ++i) now += one.spheres.attached[i].size();
    flips += now != std::exchange(partners, now);
    one.clock.time += kStep;
    three.clock.time += kStep;
  }
  EXPECT_GT(partners, 50u);
  EXPECT_GT(flips, 3u);
}

TEST(SphereContacts, DoNotDependOnWhenListsWereMade) {
  const Model model = two_types();  // lists are made anew in the middle of every step
  Model patient = model;            // never
  patient.contact.skin = 1.0;
  ShapeLibrary shapes;
  Tissue whole = heap(), split = whole;
  Mechanics kept = mechanics_of(patient, shapes, 1);
  for (int step = 0; step < 30; ++step) {
    Mechanics fresh = mechanics_of(model, shapes, 1);
    ASSERT_TRUE(kept.step(whole, kStep, pull(whole.cells.size(), step)).ok());
    ASSERT_TRUE(fresh.step(split, kStep, pull(whole.cells.size(), step)).ok());
    expect_equal(whole, split, step);
    for (Tissue* t : {&whole, &split}) {
      t->clock.time += kStep;
      for (double& radius : t->spheres.radius) radius *= 1.0002;
    }
    kept.parameters_changed();
    Mechanics again = mechanics_of(model, shapes, 1);  // what a restart would see
    const BodyValues a = kept.values(whole), b = again.values(split);
    EXPECT_EQ(a.pressure, b.pressure) << step;
    EXPECT_EQ(a.contact_area, b.contact_area) << step;
  }
}

TEST(SphereContacts, PressuresFollowFlagsAndSistersAsIfFoundAnew) {
  const Model model = two_types();
  ShapeLibrary shapes;
  Tissue tissue = heap();
  Mechanics kept = mechanics_of(model, shapes, 1);
  double changed = 0.0;
  std::vector<double> last;
  for (int step = 0; step < 12; ++step) {
    ASSERT_TRUE(kept.step(tissue, kStep, pull(tissue.cells.size(), step)).ok());
    tissue.clock.time += kStep;
    Mechanics fresh = mechanics_of(model, shapes, 1);
    const std::vector<double> here = kept.pressures(tissue);
    EXPECT_EQ(here, fresh.pressures(tissue)) << step;
    if (!last.empty()) changed = std::max(changed, std::abs(here[5] - last[5]));
    last = here;
  }
  EXPECT_GT(changed, 0.0);
}

TEST(SphereContacts, ForcesOfAHeapAreTheGradientOfItsEnergy) {
  const Model model = two_types();
  ShapeLibrary shapes;
  Tissue tissue = heap();
  {
    Mechanics mechanics = mechanics_of(model, shapes, 1);  // who touches, adheres
    ASSERT_TRUE(mechanics.step(tissue, 1e-3, std::vector<Vec3d>(tissue.cells.size())).ok());
  }
  std::vector<Vec3d> force, unused;
  Mechanics mechanics = mechanics_of(model, shapes, 1);
  (void)mechanics.energy_and_forces(tissue, force);
  double scale = 0.0;
  for (const Vec3d& f : force) scale += norm2(f);
  ASSERT_GT(scale, 1.0);
  const Random random(4, RandomStream::kInitialPosition);
  for (std::uint64_t direction = 0; direction < 6; ++direction) {
    double predicted = 0.0;
    std::vector<Vec3d> along;
    for (std::size_t i = 0; i < force.size(); ++i) {
      along.push_back(random.direction(CellId::founder(i + 1), 50 + direction));
      predicted -= dot(along[i], force[i]);
    }
    const auto energy_at = [&](double s) {
      Tissue moved = tissue;
      for (std::size_t i = 0; i < along.size(); ++i) moved.spheres.position[i] += along[i] * s;
      return mechanics_of(model, shapes, 1).energy_and_forces(moved, unused);
    };
    const double h = 1e-6;
    EXPECT_NEAR((energy_at(h) - energy_at(-h)) / (2.0 * h), predicted, 1e-6 * std::sqrt(scale));
  }
}

TEST(SphereContacts, SeeTheNearestImageInAPeriodicDomain) {
  Model model = test::clusters_model(0.1);
  model.space.box = {{0, 0, 0}, {60, 60, 60}};
  model.space.boundary[0] = {BoundaryKind::kPeriodic, BoundaryKind::kPeriodic};
  ShapeLibrary shapes;
  const std::vector<BodyKind> bodies(2, BodyKind::kSphere);
  // R = 5, E = 0.45, ν = 0.4, not attached at δ = 1: the Hertz force 0.5646924 nN (physics page).
  Tissue tissue = test::make_tissue(model, shapes, {{1, 5, 5}, {52, 5, 5}}, bodies, 162, 5.0);
  std::vector<Vec3d> force;
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  (void)mechanics.energy_and_forces(tissue, force);
  const std::size_t left = tissue.spheres.position[0].x < 30.0 ? 0 : 1;
  EXPECT_NEAR(force[left].x, 0.5646924, 1e-6);
  EXPECT_NEAR(force[1 - left].x, -0.5646924, 1e-6);
}

TEST(SphereContacts, PressureAndAreaOfAnAttachedPairAreThoseOfTheLaw) {
  const Model model = test::clusters_model(0.1);
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {9, 0, 0}}, {BodyKind::kSphere, BodyKind::kSphere}, 162, 5.0);
  const CellId ids[2] = {tissue.cells.rows[0].id, tissue.cells.rows[1].id};
  tissue.spheres.attached = {};
  for (int i = 0; i < 2; ++i) tissue.spheres.attached.push_back(std::span(&ids[1 - i], 1));
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  // Reference pair at δ = 1: F = −0.3592068 nN, a = 3.026791 µm (physics page); p = d F/(6 V), V = V0 e^(−p/K_V).
  const BodyValues values = mechanics.values(tissue);
  const double volume = 4.0 / 3.0 * std::numbers::pi * 125.0;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(values.pressure[i] * std::exp(-values.pressure[i] / 2.5), -9.0 * 0.3592068 / (6.0 * volume), 1e-9);
    EXPECT_NEAR(values.contact_area[i], std::numbers::pi * 3.026791 * 3.026791, 1e-4);
  }
}

}  // namespace
}  // namespace morula
