/// A surface that does not pass through itself.
#include "core/contact/self_contact.h"

#include <gtest/gtest.h>

#include "core/contact/surface_pair.h"
#include "core/random/philox.h"
#include "tests/coupling/energy_gradient.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kTouch = 0.3;  // µm

/// A soft, slack cell whose volume hardly resists.
Model slack_model(double self_contact) {
  Model model = test::clusters_model(0.0);
  model.contact.range = 0.5;
  model.contact.repulsion = 100.0;
  model.types[0].shell.tension = 0.01;
  model.types[0].shell.bulk_modulus = 0.01;
  model.types[0].self_contact = self_contact;
  return model;
}

/// A cell pressed into a disc whose sheets are `thickness` apart in the middle (negative: they have passed through each other).
Tissue disc(const Model& model, ShapeLibrary& shapes, double thickness, double noise) {
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  const Random random(5, RandomStream::kInitialPosition);
  std::uint64_t n = 0;
  for (Vec3d& x : tissue.shells.position) {
    x = {1.3 * x.x, 1.3 * x.y, 0.5 * thickness / 6.0 * x.z};
    x += random.direction(CellId(1), n++) * noise;
  }
  return tissue;
}

double energy_of(const Model& model, ShapeLibrary& shapes, const Tissue& tissue, std::vector<Vec3d>& force) {
  return Mechanics(model, {}, shapes, Comm(), 1).energy_and_forces(tissue, force);
}

TEST(SelfContact, LeavesASmoothCellAlone) {
  const Model with = slack_model(kTouch), without = slack_model(0.0);
  ShapeLibrary shapes;
  const Tissue tissue = test::make_tissue(with, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  std::vector<Vec3d> a, b;
  EXPECT_EQ(energy_of(with, shapes, tissue, a), energy_of(without, shapes, tissue, b));
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i], b[i]);
}

TEST(SelfContact, ForceIsMinusTheGradientAndHasNoSumAndNoTorque) {
  const Model with = slack_model(kTouch), without = slack_model(0.0);
  ShapeLibrary shapes;
  for (const double thickness : {0.25, -0.2}) {  // sheets that meet with their inner sides, and with their outer ones
    const Tissue tissue = disc(with, shapes, thickness, 0.01);
    std::vector<Vec3d> force, other;
    const double energy = energy_of(with, shapes, tissue, force), bare = energy_of(without, shapes, tissue, other);
    EXPECT_GT(energy, bare + 1.0) << "the sheets touch";
    // the contact alone, so that other terms do not hide it
    const auto contact_energy = [&](const Tissue& at) {
      std::vector<Vec3d> unused;
      return energy_of(with, shapes, at, unused) - energy_of(without, shapes, at, unused);
    };
    double size = 0.0, lever = 0.0;
    Vec3d sum, torque;
    for (std::size_t i = 0; i < force.size(); ++i) {
      force[i] -= other[i];
      sum += force[i], torque += cross(tissue.shells.position[i], force[i]);
      size += norm(force[i]), lever += norm(tissue.shells.position[i]) * norm(force[i]);
    }
    EXPECT_LT(norm(sum), 1e-12 * size);
    EXPECT_LT(norm(torque), 1e-12 * lever);
    SCOPED_TRACE(thickness);
    test::expect_minus_gradient(tissue, force, 12, 2e-7, contact_energy);
  }
}

/// Press the poles of a cell together for ten minutes; how far the upper cap ends above the lower one, by the mean of its nodes [µm].
double pressed(double self_contact, int& crossings) {
  const Model model = slack_model(self_contact);
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  std::vector<std::uint32_t> cap[2];
  for (std::uint32_t i = 0; i < tissue.shells.node_count(); ++i)
    if (std::abs(tissue.shells.position[i].z) > 5.0) cap[tissue.shells.position[i].z > 0.0].push_back(i);
  std::vector<Vec3d> force(Mechanics::external_size(tissue));
  for (int side = 0; side < 2; ++side)
    for (const std::uint32_t i : cap[side]) force[i] = {0, 0, (side ? -1.0 : 1.0) / static_cast<double>(cap[side].size())};
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  double dt = 0.5, time = 0.0;
  crossings = 0;
  int retries = 0;
  while (time < 600.0 && retries < 200) {
    const auto done = mechanics.step(tissue, dt, force);
    if (!done.ok()) {
      dt *= 0.5, ++retries;
      continue;
    }
    crossings += done->crossings;
    time += dt;
    tissue.clock.time = time;
    dt = std::min(dt * std::min(1.5, 0.135 / std::max(done->displacement, 1e-9)), 20.0);
  }
  EXPECT_GE(time, 600.0);
  double height[2] = {0.0, 0.0};
  for (int side = 0; side < 2; ++side)
    for (const std::uint32_t i : cap[side]) height[side] += tissue.shells.position[i].z / static_cast<double>(cap[side].size());
  return height[1] - height[0];
}

TEST(SelfContact, StopsTheSheetsOfAPressedCellBeforeTheyMeet) {
  int crossings = 0;
  const double apart = pressed(kTouch, crossings);
  EXPECT_GT(apart, 0.8 * kTouch);
  EXPECT_LT(apart, 1.2);
  EXPECT_LT(pressed(0.0, crossings), -1.0) << "without it they pass through each other";
}

/// Whether a node of some face is nearer than `reach` to one of another that is not within `rings` edges.
bool meets_itself(const PairBody& body, double reach, int rings) {
  NodesAround around(*body.topology);
  for (std::uint32_t f = 0; f < body.topology->face_count(); ++f) {
    around.find(f, rings);
    for (std::uint32_t g = 0; g < body.topology->face_count(); ++g) {
      if (around.touch(g)) continue;
      for (const std::uint32_t a : body.topology->faces()[f])
        for (const std::uint32_t b : body.topology->faces()[g])
          if (norm(body.node(a) - body.node(b)) < reach) return true;
    }
  }
  return false;
}

/// The quick test may not know, but never says that surfaces are apart that are not; of cells as they are in tissues it knows.
TEST(SelfContact, IsLookedForOnlyWhereItMayBe) {
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(162).value();
  const Random random(7, RandomStream::kInitialPosition);
  constexpr double kReach = 0.75;
  constexpr int kRings = 2;
  int known = 0, meet = 0;
  for (std::uint64_t n = 0; n < 60; ++n) {
    const Vec3d stretch = Vec3d{1, 1, 1} + random.direction(CellId(1), n) * (0.015 * static_cast<double>(n));  // up to 0.9
    const Vec3d dent = random.direction(CellId(2), n);
    std::vector<Vec3d> position;
    for (const Vec3d& unit : shape->position) {
      const Vec3d x = unit * (6.0 / norm(unit));
      const double deep = std::max(0.0, dot(x, dent) - 6.0 + 0.2 * static_cast<double>(n));
      position.push_back({stretch.x * x.x - deep * dent.x, stretch.y * x.y - deep * dent.y, stretch.z * x.z - deep * dent.z});
    }
    const PairBody body{.topology = shape->topology.get(), .position = position, .node_normal = {}};
    const bool may = may_meet_itself(body, kReach, kRings), does = meets_itself(body, kReach, kRings);
    EXPECT_TRUE(may || !does) << n;
    known += !may;
    meet += does;
    EXPECT_FALSE(may && n < 8) << n << ": nearly a ball";
  }
  EXPECT_GT(known, 8);
  EXPECT_GT(meet, 5);
}

TEST(SelfContact, CountsOnlyFacesThatAreFarAlongTheSurface) {
  EXPECT_EQ(self_contact_rings(320, 6.0, 0.7), 1);   // edges of 1.8 µm
  EXPECT_EQ(self_contact_rings(1280, 6.0, 0.7), 2);  // 0.9 µm
  EXPECT_EQ(self_contact_rings(5120, 6.0, 0.7), 4);  // 0.45 µm
  ShapeLibrary shapes;
  const Topology& topology = *shapes.icosphere(162).value()->topology;
  NodesAround around(topology);
  for (const int rings : {1, 2, 3}) {
    around.find(17, rings);
    std::vector<char> expected(topology.face_count(), 0);  // faces that share a node, and those that share one with these …
    expected[17] = 1;
    for (int ring = 0; ring < rings; ++ring) {
      std::vector<char> node(topology.node_count(), 0);
      for (std::uint32_t f = 0; f < topology.face_count(); ++f)
        for (const std::uint32_t i : topology.faces()[f]) node[i] = node[i] || expected[f];
      for (std::uint32_t f = 0; f < topology.face_count(); ++f)
        for (const std::uint32_t i : topology.faces()[f]) expected[f] = expected[f] || node[i];
    }
    for (std::uint32_t f = 0; f < topology.face_count(); ++f) EXPECT_EQ(around.touch(f), expected[f] != 0) << rings << ' ' << f;
  }
}

}  // namespace
}  // namespace morula
