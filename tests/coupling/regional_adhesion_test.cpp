/// Adhesion that differs by the marks on the faces in contact.
#include <gtest/gtest.h>

#include "core/mesh/primitives.h"
#include "core/random/philox.h"
#include "coupling/face_marks.h"
#include "coupling/simulation.h"
#include "tests/coupling/energy_gradient.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr BodyKind kShell = BodyKind::kShell, kSphere = BodyKind::kSphere;

TEST(RegionalAdhesion, IsThatOfTheFirstRuleThatBothFacesFollow) {
  const std::vector<AdhesionRule> rules{{0, 1, 0.3}, {0, -1, 0.1}, {-1, 1, 0.2}};
  const auto between = [&](int marks, std::uint8_t a, std::uint8_t b) {  // by a table, and by the rules where there are many marks
    const std::uint8_t of_a[2] = {a, 0}, of_b[2] = {b, 0};
    const auto bytes = static_cast<std::size_t>(marks > 8 ? 2 : 1);
    return RegionalAdhesion(0.5, rules, marks).between({of_a, bytes}, {of_b, bytes});
  };
  for (const int marks : {2, 8, 12}) {
    EXPECT_EQ(between(marks, 0b00, 0b00), 0.5) << "no rule";
    EXPECT_EQ(between(marks, 0b00, 0b01), 0.5);
    EXPECT_EQ(between(marks, 0b01, 0b00), 0.1);
    EXPECT_EQ(between(marks, 0b11, 0b01), 0.1);
    EXPECT_EQ(between(marks, 0b10, 0b11), 0.2);
    EXPECT_EQ(between(marks, 0b01, 0b10), 0.3) << "the first listed";
    EXPECT_EQ(between(marks, 0b11, 0b11), 0.3);
    EXPECT_EQ(RegionalAdhesion(0.5, rules, marks).between({}, {}), 0.5) << "bodies without marks";
  }
  const std::uint8_t eleventh[2] = {0, 0b100};
  EXPECT_EQ(RegionalAdhesion(0.5, std::vector<AdhesionRule>{{10, 10, 0.7}}, 12).between(eleventh, eleventh), 0.7);
}

/// Bodies and the law between them; `plate`: above an obstacle whose face is at z = −5.9.
struct Case {
  const char* name;
  std::vector<BodyKind> kinds;
  std::shared_ptr<const SurfaceLaw> law;
  bool plate;
};
const Case kCases[] = {
    {"Shells", {kShell, kShell, kShell}, tent_law(), false},
    {"ShellsAndASphere", {kShell, kSphere, kShell}, tent_law(), false},
    {"ShellsOnAPlate", {kShell, kSphere, kShell}, tent_law(), true},
    {"ShellsByMaugisDugdale", {kShell, kShell, kShell}, maugis_dugdale_law(), true},
    {"ShellsByAFallingTraction", {kShell, kShell, kShell}, falling_law(), true},
};

Model model_of(const Case& given) {
  Model model = test::clusters_model(0.3);
  model.contact.range = 0.8;
  if (given.plate) {
    TriangleMesh plate = *make_box({60.0, 60.0, 4.0}, 60.0);
    for (Vec3d& p : plate.position) p.z -= 7.9;
    model.obstacles = {ObstacleSpec{"plate", plate.position, plate.faces, false, {}}};
    model.pairs.assign(4, model.pairs[0]);
  }
  model.mark_names = {"one", "two"};
  for (ContactPair& pair : model.pairs) {
    pair.law = given.law;
    pair.own.set("modulus", 1.0);
    pair.regions = {{0, -1, 0.05}, {-1, 0, 0.05}, {1, 1, 0.6}};
  }
  return model;
}

/// Every face has marks of its own, without any pattern: borders of regions are everywhere.
Tissue marked_at_random(const Model& model, ShapeLibrary& shapes, const std::vector<BodyKind>& kinds) {
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {11.6, 0.3, 0.2}, {5.2, 10.4, 0.4}}, kinds);
  std::uint64_t n = 0;
  const Random random(7, RandomStream::kInitialPosition);
  for (auto* positions : {&tissue.shells.position, &tissue.spheres.position})
    for (Vec3d& p : *positions) p += random.direction(CellId(1), n++) * 0.05;
  for (std::size_t s = 0; s < tissue.shells.size(); ++s) {
    auto& mark = tissue.shells.faces_of(s).mark;
    mark.resize(tissue.shells.topology(s).face_count());
    for (std::uint8_t& m : mark) m = static_cast<std::uint8_t>(random.uniform(CellId(2), n++).first * 4.0);
  }
  tissue.obstacle_offset.resize(model.obstacles.size());
  return tissue;
}

double energy_of(const Model& model, ShapeLibrary& shapes, const Tissue& tissue, std::vector<Vec3d>& force) {
  return Mechanics(model, contact_obstacles(model).value(), shapes, Comm(), 1).energy_and_forces(tissue, force);
}

class EveryRegionOfBodies : public testing::TestWithParam<Case> {};

TEST_P(EveryRegionOfBodies, HasAForceThatIsMinusTheGradientOfTheEnergy) {
  const Model model = model_of(GetParam());
  ShapeLibrary shapes;
  const Tissue tissue = marked_at_random(model, shapes, GetParam().kinds);
  std::vector<Vec3d> force, unused;
  (void)energy_of(model, shapes, tissue, force);
  double size = 0.0;
  Vec3d total;
  for (const Vec3d& f : force) size += norm(f), total += f;
  if (!GetParam().plate) {
    EXPECT_LT(norm(total), 1e-12 * size);
  }
  test::expect_minus_gradient(tissue, force, 12, 1e-7, [&](const Tissue& moved) { return energy_of(model, shapes, moved, unused); });
}

TEST_P(EveryRegionOfBodies, IsThePairItselfWhereTheRegionIsEverything) {
  Model regional = model_of(GetParam()), plain = regional;
  for (ContactPair& pair : regional.pairs)
    pair.regions = {{-1, -1, pair.adhesion}}, pair.adhesion = GetParam().kinds[1] == kSphere ? 0.3 : 0.0;
  for (ContactPair& pair : plain.pairs) pair.regions.clear();
  ShapeLibrary shapes;
  const Tissue tissue = marked_at_random(plain, shapes, GetParam().kinds);
  std::vector<Vec3d> with, without;
  const double a = energy_of(regional, shapes, tissue, with), b = energy_of(plain, shapes, tissue, without);
  EXPECT_NEAR(a, b, 1e-12 * std::abs(b));
  for (std::size_t i = 0; i < with.size(); ++i) EXPECT_LT(norm(with[i] - without[i]), 1e-11) << i;
}

INSTANTIATE_TEST_SUITE_P(Every, EveryRegionOfBodies, testing::ValuesIn(kCases),
                         [](const testing::TestParamInfo<Case>& given) { return std::string(given.param.name); });

/// A cell with a cap that does not adhere, 0.1 µm above a plate that all else sticks to, and drawn up by half of π R W (dcm.md §8: what holds it).
Model capped_above_a_plate(double up) {
  Model model = test::clusters_model(0.0);
  model.contact.range = 0.5;
  model.contact.repulsion = 100.0;
  TriangleMesh plate = *make_box({40.0, 40.0, 4.0}, 40.0);
  for (Vec3d& p : plate.position) p.z -= 2.0;
  model.obstacles = {ObstacleSpec{"plate", plate.position, plate.faces, false, {}}};
  ContactPair pair{0.1, 50.0, 50.0}, turned = pair;
  pair.regions = {{0, -1, 0.0}};
  turned.regions = {{-1, 0, 0.0}};
  model.pairs = {model.pairs[0], pair, turned, turned};
  model.mark_names = {"apical"};
  FaceMark cap;
  cap.angle = 1.2;
  cap.axis = {0, 0, up};
  model.marks = {cap};
  CellLoad load;
  load.name = "up";
  load.force = {0, 0, 1.0};
  model.loads = {load};
  return model;
}

double contact_after_an_hour(double up) {
  const Model model = capped_above_a_plate(up);
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 6.1}}, {kShell});
  tissue.obstacle_offset.resize(1);
  auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
  while (simulation->tissue().clock.time < 3600.0) {
    const auto done = simulation->step(3600.0);
    EXPECT_TRUE(done.ok());
    if (!done.ok()) break;
  }
  return simulation->values().contact_area[0];
}

TEST(ACellWithABareCap, SticksToAPlateOnlyWithTheOtherSide) {
  const double cap_down = contact_after_an_hour(-1.0), cap_up = contact_after_an_hour(1.0);
  EXPECT_GT(cap_up, 10.0);
  EXPECT_EQ(cap_down, 0.0);
}

/// Marks that are given while a cell lies in contact act at once, and as if the workspace were made anew.
TEST(RegionalAdhesion, FollowsMarksThatChange) {
  const Model model = model_of(kCases[0]);
  ShapeLibrary shapes;
  Tissue tissue = marked_at_random(model, shapes, kCases[0].kinds);
  Mechanics kept(model, {}, shapes, Comm(), 1);
  const double before = kept.values(tissue).contact_area[0];
  EXPECT_GT(before, 1.0);
  Tissue other = tissue;
  for (dcm::FaceState& face : tissue.shells.face)
    for (std::uint8_t& mark : face.mark) mark ^= 1;
  other.shells.face = tissue.shells.face;
  const std::vector<Vec3d> none(Mechanics::external_size(tissue));
  Mechanics fresh(model, {}, shapes, Comm(), 1);
  ASSERT_TRUE(kept.step(tissue, 0.2, none).ok());
  ASSERT_TRUE(fresh.step(other, 0.2, none).ok());
  for (std::size_t i = 0; i < tissue.shells.position.size(); ++i) ASSERT_EQ(tissue.shells.position[i], other.shells.position[i]);
}

}  // namespace
}  // namespace morula
