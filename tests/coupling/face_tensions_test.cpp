#include "coupling/mechanics/face_tensions.h"

#include <gtest/gtest.h>

#include <random>

#include "coupling/face_marks.h"
#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kCap = 1.1, kOwn = 0.5, kLateral = 0.2;

TensionRegion region(int mark, double tension) {
  TensionRegion out;
  out.mark = mark;
  out.tension = tension;
  return out;
}

/// A region at the top of every cell, and a lateral tension.
Model model_with_regions() {
  Model model = test::clusters_model();
  model.mark_names = {"top"};
  FaceMark rule;
  rule.angle = 1.0;
  model.marks = {rule};
  model.types[0].regional_tension.regions = {region(0, kCap), region(TensionRegion::kLateral, kLateral)};
  return model;
}

Mechanics make_mechanics(const Model& model, ShapeLibrary& shapes) {
  return Mechanics(model, contact_obstacles(model).value(), shapes, Comm(), 1);
}

/// Two rough cells in contact with marks, and any contact of their faces.
Tissue rough_pair(const Model& model, ShapeLibrary& shapes) {
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {0, 0.3, 11.9}}, {BodyKind::kShell, BodyKind::kShell});
  mark_new_shells(model, tissue);
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<float> uniform;
  for (Vec3d& x : tissue.shells.position) x += 0.05 * Vec3d{normal(engine), normal(engine), normal(engine)};
  for (dcm::FaceState& face : tissue.shells.face) {
    face.contact.resize(face.mark.size());
    for (float& part : face.contact) part = uniform(engine);
  }
  return tissue;
}

TEST(RegionalTension, IsThatOfTheFirstMarkAndGoesToTheLateralOneWithContact) {
  RegionalTension t;
  EXPECT_EQ(t.of_face(0.5, MarkSet(std::array<std::uint8_t, 1>{0xFF}), 1.0, 0.0), 0.5);
  t.regions = {region(2, 1.0), region(0, 2.0)};
  EXPECT_EQ(t.of_face(0.5, MarkSet(std::array<std::uint8_t, 1>{0b010}), 1.0, 0.0), 0.5) << "no mark, no lateral tension";
  EXPECT_EQ(t.of_face(0.5, MarkSet(std::array<std::uint8_t, 1>{0b001}), 0.0, 0.0), 2.0);
  EXPECT_EQ(t.of_face(0.5, MarkSet(std::array<std::uint8_t, 1>{0b101}), 0.0, 0.0), 1.0) << "the first listed";
  t.regions.push_back(region(TensionRegion::kWhole, 0.7));
  EXPECT_EQ(t.of_face(0.5, MarkSet(std::array<std::uint8_t, 1>{0b010}), 0.0, 0.0), 0.7);
  t.regions.push_back(region(TensionRegion::kLateral, 0.2));
  EXPECT_DOUBLE_EQ(t.of_face(0.5, MarkSet(std::array<std::uint8_t, 1>{0b001}), 0.25, 0.0), 2.0 + 0.25 * (0.2 - 2.0));
  EXPECT_EQ(t.drop_in_contact(0.5, 0.0), 0.0) << "faces have it";
  t.lateral_adheres = true;
  EXPECT_DOUBLE_EQ(t.drop_in_contact(0.5, 0.0), 0.7 - 0.2);
  EXPECT_EQ(t.of_face(0.5, MarkSet(std::array<std::uint8_t, 1>{0b001}), 0.25, 0.0), 2.0) << "the drop is an energy of the contact";
}

TEST(RegionalTension, FollowsItsCourseAndItsModulation) {
  TensionRegion r = region(0, 0.5);
  r.course = {{0.0, 10.0}, {1.0, 3.0}};
  r.amplitude = 0.4;
  r.period = 40.0;
  EXPECT_DOUBLE_EQ(r.at(0.0), 0.5);
  EXPECT_NEAR(r.at(10.0), 0.5 * 3.0 * 1.4, 1e-14);  // a quarter of the period: sin = 1
  EXPECT_NEAR(r.at(30.0), 0.5 * 3.0 * 0.6, 1e-14);
}

TEST(FaceTensions, EnergyIsTheSumOfTensionTimesArea) {
  const Model with = model_with_regions();
  Model without = with;
  without.types[0].regional_tension = {};
  ShapeLibrary shapes;
  const Tissue tissue = rough_pair(with, shapes);
  std::vector<Vec3d> force;
  Mechanics a = make_mechanics(with, shapes), b = make_mechanics(without, shapes);
  const double difference = a.energy_and_forces(tissue, force) - b.energy_and_forces(tissue, force);
  double expected = 0.0;
  for (std::size_t s = 0; s < 2; ++s) {
    const auto x = tissue.shells.nodes(s);
    const dcm::FaceState& face = tissue.shells.faces_of(s);
    for (std::size_t f = 0; f < face.mark.size(); ++f) {
      const Triangle& t = tissue.shells.topology(s).faces()[f];
      const double area = 0.5 * norm(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])), free = face.mark[f] ? kCap : kOwn;
      expected += (free + face.contact[f] * (kLateral - free) - kOwn) * area;
    }
  }
  EXPECT_GT(std::abs(expected), 10.0);
  EXPECT_NEAR(difference, expected, 1e-10 * std::abs(expected));
}

TEST(FaceTensions, ForceIsMinusTheGradientAndHasNoSumAndNoTorque) {
  const Model model = model_with_regions();
  ShapeLibrary shapes;
  const Tissue tissue = rough_pair(model, shapes);
  Mechanics mechanics = make_mechanics(model, shapes);
  std::vector<Vec3d> force, other;
  mechanics.energy_and_forces(tissue, force);
  Vec3d sum{}, torque{};
  double size = 0.0, lever = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    sum += force[i], torque += cross(tissue.shells.position[i], force[i]);
    size += norm(force[i]), lever += norm(tissue.shells.position[i]) * norm(force[i]);
  }
  EXPECT_LT(norm(sum), 1e-12 * size);
  EXPECT_LT(norm(torque), 1e-12 * lever);

  std::mt19937_64 engine(11);
  std::normal_distribution<double> normal;
  constexpr double h = 1e-5;
  for (int k = 0; k < 20; ++k) {
    std::vector<Vec3d> direction;
    double slope = 0.0, largest = 0.0;
    for (const Vec3d& f : force) {
      direction.push_back({normal(engine), normal(engine), normal(engine)});
      slope -= dot(f, direction.back());
      largest += std::abs(dot(f, direction.back()));
    }
    double energy[2];
    for (int side = 0; side < 2; ++side) {
      Tissue moved = tissue;
      for (std::size_t i = 0; i < direction.size(); ++i) moved.shells.position[i] += direction[i] * (side ? h : -h);
      Mechanics there = make_mechanics(model, shapes);
      energy[side] = there.energy_and_forces(moved, other);
    }
    EXPECT_NEAR((energy[1] - energy[0]) / (2 * h), slope, 1e-6 * largest);
  }
}

/// dcm.md §16.3 and §16.4: a pair that is turned and moved has the same energy and turned forces; cells that change places, with their
/// marks, feel what those felt whose places they took.
TEST(FaceTensions, FeelNeitherRigidMotionNorTheOrderOfCells) {
  const Model model = model_with_regions();
  ShapeLibrary shapes;
  const Tissue tissue = rough_pair(model, shapes);
  std::vector<Vec3d> force, there;
  const double energy = make_mechanics(model, shapes).energy_and_forces(tissue, force);
  double size = 0.0;
  for (const Vec3d& f : force) size += norm(f);

  const auto turn = [](const Vec3d& v) {
    return Vec3d{std::cos(0.9) * v.x - std::sin(0.9) * v.y, std::sin(0.9) * v.x + std::cos(0.9) * v.y, v.z};
  };
  Tissue turned = tissue;
  for (Vec3d& x : turned.shells.position) x = turn(x) + Vec3d{3, -7, 11};
  EXPECT_NEAR(make_mechanics(model, shapes).energy_and_forces(turned, there), energy, 1e-12 * std::abs(energy));
  for (std::size_t i = 0; i < force.size(); ++i) EXPECT_LT(norm(there[i] - turn(force[i])), 1e-12 * size);

  Tissue swapped = tissue;
  for (std::size_t s = 0; s < 2; ++s) {
    const auto from = std::as_const(tissue.shells).nodes(1 - s);
    std::copy(from.begin(), from.end(), swapped.shells.nodes(s).begin());
    swapped.shells.face[s] = tissue.shells.face[1 - s];
  }
  EXPECT_NEAR(make_mechanics(model, shapes).energy_and_forces(swapped, there), energy, 1e-12 * std::abs(energy));
  for (std::size_t i = 0; i < force.size(); ++i) EXPECT_LT(norm(there[i] - force[(i + 162) % 324]), 1e-12 * size);
}

/// The stiffness of a region is positive semi-definite whatever its tension, beside the own one and under adhesion: long steps from a
/// rough shape lower the energy at once, also where a region pulls much less than the cell's own tension, or not at all.
TEST(FaceTensions, LowerTheEnergyInLongStepsWhateverTheRegion) {
  for (const double cap : {0.0, 0.05, 5.0}) {
    Model model = model_with_regions();
    model.types[0].regional_tension.regions[0].tension = cap;
    model.types[0].shell.shape_stiffness = 0.3;  // a rough mesh that does not crumple
    model.step.max_displacement = 10.0;
    model.step.max_newton = 30;
    ShapeLibrary shapes;
    Tissue tissue = rough_pair(model, shapes);
    Mechanics mechanics = make_mechanics(model, shapes);
    std::vector<Vec3d> force;
    double energy = mechanics.energy_and_forces(tissue, force);
    const std::vector<Vec3d> none(Mechanics::external_size(tissue));
    for (int k = 0; k < 5; ++k) {
      const auto done = mechanics.step(tissue, 2.0, none);
      ASSERT_TRUE(done.ok()) << done.error().what;
      EXPECT_LT(done->energy, energy);
      EXPECT_EQ(done->halvings, 0) << cap;
      EXPECT_LE(done->newton, 12) << cap << ": with the region's own stiffness in the matrix few iterations do";
      energy = done->energy;
    }
  }
}

/// Young and Laplace: every region is held by its own 2γ/R (dcm.md T4.1: 0.34 % at 642 nodes).
TEST(FaceTensions, EachRegionOfASphereNeedsItsOwnLaplacePressure) {
  Model with = test::clusters_model();
  with.types[0].shell = {};
  with.types[0].shell.shape_stiffness = with.types[0].shell.barrier_stiffness = 0.0;
  with.types[0].shell.tension = kOwn;
  with.mark_names = {"top"};
  FaceMark rule;
  rule.angle = 1.2;
  with.marks = {rule};
  with.types[0].regional_tension.regions = {region(0, kCap)};
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(with, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 642);
  for (Vec3d& x : tissue.shells.position) x = normalized(x) * 6.0;
  tissue.shells.reference_volume[0] = enclosed_volume(tissue.shells.topology(0).faces(), tissue.shells.position, {});  // no pressure
  mark_new_shells(with, tissue);
  std::vector<Vec3d> force;
  make_mechanics(with, shapes).energy_and_forces(tissue, force);
  const Topology& topology = tissue.shells.topology(0);
  std::vector<Vec3d> push(force.size());  // ∂V/∂x
  std::vector<int> marked(force.size(), 0), around(force.size(), 0);
  for (std::size_t f = 0; f < topology.face_count(); ++f) {
    const Triangle& t = topology.faces()[f];
    const auto& x = tissue.shells.position;
    const Vec3d n = cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]) * (1.0 / 6.0);
    for (const std::uint32_t i : t) push[i] += n, marked[i] += tissue.shells.face[0].mark[f], ++around[i];
  }
  for (const bool cap : {true, false}) {
    double work = 0.0, square = 0.0;
    for (std::size_t i = 0; i < force.size(); ++i)
      if (marked[i] == (cap ? around[i] : 0)) work -= dot(force[i], push[i]), square += dot(push[i], push[i]);
    EXPECT_NEAR(work / square / (2.0 * (cap ? kCap : kOwn) / 6.0), 1.0, 0.006) << cap;
  }
}

/// The stiffness of regions is that of the tension itself: a region that is the whole surface does what the cell's own tension does, at any step.
TEST(FaceTensions, ARegionThatIsTheWholeSurfaceIsTheOwnTension) {
  Model own = test::clusters_model(), whole = own;
  whole.types[0].shell.tension = 0.01;
  whole.types[0].regional_tension.regions = {region(TensionRegion::kWhole, own.types[0].shell.tension)};
  for (Model* m : {&own, &whole})
    m->step.first_tolerance = m->step.later_tolerance = 1e-6, m->step.newton_stop = 1e-4, m->step.max_newton = 8;
  ShapeLibrary shapes;
  Tissue a = test::make_tissue(own, shapes, {{0, 0, 0}, {0, 0, 11.9}}, {BodyKind::kShell, BodyKind::kShell}), b = a;
  for (Tissue* t : {&a, &b}) {
    const Model& model = t == &a ? own : whole;
    Mechanics mechanics = make_mechanics(model, shapes);
    const std::vector<Vec3d> none(Mechanics::external_size(*t));
    for (int k = 0; k < 4; ++k) {
      const auto done = mechanics.step(*t, 5.0, none);
      ASSERT_TRUE(done.ok());
      EXPECT_EQ(done->halvings, 0);
      t->clock.time += 5.0;
    }
  }
  double most = 0.0, way = 0.0;
  const Tissue start = test::make_tissue(own, shapes, {{0, 0, 0}, {0, 0, 11.9}}, {BodyKind::kShell, BodyKind::kShell});
  for (std::size_t i = 0; i < a.shells.position.size(); ++i) {
    most = std::max(most, norm(a.shells.position[i] - b.shells.position[i]));
    way = std::max(way, norm(a.shells.position[i] - start.shells.position[i]));
  }
  EXPECT_GT(way, 0.1);
  EXPECT_LT(most, 2e-4 * way);
}

TEST(FaceTensions, LateralContactIsEasedAndIsThatOfTheTouchingFaces) {
  Model model = model_with_regions();
  model.types[0].regional_tension.easing = 20.0;
  model.step.max_step = 5.0;
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {0, 0, 11.9}}, {BodyKind::kShell, BodyKind::kShell});
  auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
  while (simulation->tissue().clock.time < 200.0) ASSERT_TRUE(simulation->step(200.0).ok());
  const dcm::Shells& shells = simulation->tissue().shells;
  for (std::size_t s = 0; s < 2; ++s) {
    double touching = 0.0;
    const auto x = shells.nodes(s);
    for (std::size_t f = 0; f < shells.faces_of(s).contact.size(); ++f) {
      const Triangle& t = shells.topology(s).faces()[f];
      const double part = shells.faces_of(s).contact[f], area = 0.5 * norm(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]));
      EXPECT_GE(part, 0.0);
      EXPECT_LE(part, 1.0);
      touching += part * area;
      if (std::abs((x[t[0]] + x[t[1]] + x[t[2]]).z / 3.0 - 6.0) > 2.0) {
        EXPECT_EQ(part, 0.0);
      }
    }
    const double contact = simulation->values().contact_area[s];
    EXPECT_GT(contact, 20.0);
    EXPECT_NEAR(touching / contact, 1.0, 0.25);  // the taper at the rim differs, and easing lags behind
  }
}

}  // namespace
}  // namespace morula
