// A nucleus and links in the implicit step: what floats changes nothing, what is squeezed pushes back, and a nucleus stays inside.
#include <gtest/gtest.h>

#include <numbers>

#include "core/mesh/primitives.h"
#include "coupling/swaps.h"
#include "tests/coupling/one_cell_fixture.h"

namespace morula {
namespace {

using namespace test;

/// Smallest distance of the nucleus' centre behind the faces' planes: > 0 inside a cell that is star-shaped about it.
double behind_faces(const dcm::Shells& shells) {
  double least = 1e300;
  const auto x = shells.nodes(0);
  for (const Triangle& t : shells.topology(0).faces())
    least = std::min(least, dot(x[t[0]] - *shells.nucleus_of(0), normalized(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]))));
  return least;
}

Model stretched_model() {  // S1: T 3e-5 N/m, 1 Pa
  Model model = clusters_model(0.0);
  model.types[0].shell.tension = 0.03;
  model.types[0].shell.bulk_modulus = 2.5;
  CellLoad load;
  load.what = traction_load();
  load.size = 1e-3;
  model.loads = {load};
  model.step.max_step = 5.0;
  return model;
}

double axial_strain(const Model& model, double time) {
  const auto simulation = one_cell(model);
  run(*simulation, time);
  double length = 0.0, before = 0.0;
  for (const Vec3d& x : simulation->tissue().shells.position) length = std::max(length, std::abs(x.x));
  ShapeLibrary shapes;
  for (const Vec3d& x : make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}).shells.position)
    before = std::max(before, std::abs(x.x));
  return length / before - 1.0;
}

TEST(FloatingNucleus, ChangesTheStretcherByLessThanOnePercent) {  // S1.6
  Model model = stretched_model();
  for (const double time : {15.0, 150.0}) {
    model.types[0].interior = {};
    const double without = axial_strain(model, time);
    model.types[0].interior.nucleus_fraction = fraction(2.5);
    EXPECT_GT(without, 0.003);
    EXPECT_NEAR(axial_strain(model, time) / without, 1.0, 0.01) << "after " << time << " s";
  }
}

TEST(NucleusLinks, StiffenTheStretchedCellMonotonically) {  // O7.1
  Model model = stretched_model();
  double last = 1e300;
  for (const double stiffness : {0.0, 0.003, 0.03}) {
    model.types[0].interior.nucleus_fraction = fraction(2.5);
    model.types[0].interior.nucleus_links = {dcm::LinkParameters::kAll, stiffness, 0.0, false};
    const double strain = axial_strain(model, 150.0);
    EXPECT_LT(strain, 0.97 * last) << stiffness;
    last = strain;
  }
  model.types[0].interior = {};
  const double free = axial_strain(model, 150.0);
  model.types[0].interior.cortex_links = {dcm::LinkParameters::kAll, 0.01, 0.0, false};
  EXPECT_LT(axial_strain(model, 150.0), 0.9 * free);
}

TEST(FloatingNucleus, GoesWithItsCellAndCostsItNothing) {
  Model model = clusters_model(0.0);
  CellLoad load;
  load.force = {0.9, 0, 0};
  model.loads = {load};
  model.step.max_step = 10.0;
  const auto bare = one_cell(model);
  run(*bare, 200.0);
  model.types[0].interior.nucleus_fraction = fraction(2.5);
  const auto with = one_cell(model);
  run(*with, 200.0);
  const Vec3d there = mean(std::as_const(with->tissue().shells).nodes(0));
  EXPECT_GT(there.x, 3.5) << "T9.2: 0.0221 µm/s per nN";
  EXPECT_NEAR(there.x, mean(std::as_const(bare->tissue().shells).nodes(0)).x, 1e-3);
  EXPECT_LT(norm(*with->tissue().shells.nucleus_of(0) - there), 0.01);
}

/// Gap and force of the upper plate, pushed down on a cell on a plate.
struct Squeeze {
  std::vector<double> gap, force;
  double imbalance = 0.0, overlap = 0.0, inside = 1e300;
  double at(double wanted) const {
    for (std::size_t k = 1; k < gap.size(); ++k)
      if (gap[k] <= wanted) return force[k] + (force[k - 1] - force[k]) * (wanted - gap[k]) / (gap[k - 1] - gap[k]);
    return std::numeric_limits<double>::quiet_NaN();
  }
};

Squeeze squeeze(double nucleus) {
  Model model = clusters_model(0.0);
  model.contact.range = 0.5;
  model.contact.repulsion = 100.0;
  model.contact.points_per_face = 3;
  model.types[0].interior.nucleus_fraction = nucleus > 0.0 ? fraction(nucleus) : 0.0;
  TriangleMesh lower = make_box({40, 40, 4}, 10.0).value(), upper = lower;
  for (Vec3d& x : lower.position) x.z -= 8.2;
  for (Vec3d& x : upper.position) x.z += 8.2;
  const double speed = 0.02;
  model.obstacles = {{"lower", lower.position, lower.faces, false, {}, {}, {}},
                     {"upper", upper.position, upper.faces, false, {0, 0, -speed}, {}, {}}};
  model.pairs.assign(9, ContactPair{0.0, 0.1, 0.1});
  model.step.max_step = 1.0;
  // The plates bear the residual; and what is left of the nucleus' own, step by step, carries it off the middle.
  model.step.first_tolerance = 1e-5;
  model.step.later_tolerance = 1e-4;
  model.step.newton_stop = 1e-3;
  model.step.max_newton = 20;
  const auto simulation = one_cell(model);
  Squeeze out;
  while (out.gap.empty() || out.gap.back() > 8.0) {
    const auto step = simulation->step(1e6);
    if (!step.ok()) {
      ADD_FAILURE() << step.error().message;
      break;
    }
    const auto force = simulation->mechanics().obstacle_forces(simulation->tissue());
    out.gap.push_back(12.4 - speed * simulation->tissue().clock.time);
    out.force.push_back(force[1].z);
    if (nucleus == 0.0) continue;
    const auto inside = simulation->mechanics().interior_of(0);
    out.overlap = std::max(out.overlap, inside.overlap);
    out.inside = std::min(out.inside, behind_faces(simulation->tissue().shells));
  }
  return out;
}

TEST(SqueezedNucleus, PushesBackWhenThePlatesAreCloserThanItsWidth) {  // T12.3, T12.4
  const Squeeze bare = squeeze(0.0), with = squeeze(4.2);
  for (const double gap : {11.0, 9.5, 8.75}) EXPECT_NEAR(with.at(gap) / bare.at(gap), 1.0, 1e-3) << "nothing touches above 2 R_n = 8.4 µm";
  EXPECT_GT(with.at(8.25), 1.5 * bare.at(8.25));
  EXPECT_GT(with.at(8.05), 3.0 * bare.at(8.05)) << "below it the nucleus pushes";
  EXPECT_GT(with.overlap, 0.0);
  EXPECT_LT(with.overlap, 0.1);
  EXPECT_GT(with.inside, 3.8)
      << "the nucleus is inside, at its radius from every face, but for what faces under 36 nN dip in between their points";
}

/// T12.3: the balance of forces between cell, nucleus and plates is closed to 1e-8 of what a plate bears, in any state; the force on the
/// nucleus is that of the energy. Plates come down until the nucleus bears load, and stop: at rest each bears what the other does, to
/// 1e-5, for a step has converged when the energy cannot fall by more than 1e-12 of itself (here some 1e-4 nN between the plates).
TEST(SqueezedNucleus, IsHeldInBalanceByThePlates) {
  Model model = clusters_model(0.0);
  model.contact.range = 0.5;
  model.contact.repulsion = 100.0;
  model.contact.points_per_face = 3;
  model.types[0].interior.nucleus_fraction = fraction(4.2);
  TriangleMesh lower = make_box({40, 40, 4}, 10.0).value(), upper = lower;
  for (Vec3d& x : lower.position) x.z -= 8.2;
  for (Vec3d& x : upper.position) x.z += 8.2;
  const TimeCourse down{{0.0, 217.5}, {0.0, -4.35}};  // from 12.4 µm to 8.05 µm, and the nucleus is 8.4 µm wide
  model.obstacles = {{"lower", lower.position, lower.faces, false, {}, {}, {}},
                     {"upper", upper.position, upper.faces, false, {}, {0, 0, 1}, down}};
  model.pairs.assign(9, ContactPair{0.0, 0.1, 0.1});
  model.step.first_tolerance = model.step.later_tolerance = 1e-6;
  model.step.newton_stop = 1e-9;
  model.step.max_newton = 50;
  model.step.max_step = 20.0;
  const auto simulation = one_cell(model);
  run(*simulation, 216.0);
  ShapeLibrary shapes;
  Mechanics& mechanics = simulation->mechanics();
  const auto imbalance = [&] {
    const auto force = mechanics.obstacle_forces(simulation->tissue());
    return (force[0].z + force[1].z) / force[1].z;
  };
  EXPECT_GT(std::abs(imbalance()), 0.01) << "the cell moves in the medium";
  {
    Tissue tissue = simulation->tissue();
    *tissue.shells.nucleus[0] += Vec3d{0.1, 0.0, 0.1};
    Mechanics other(simulation->model(), contact_obstacles(simulation->model()).value(), shapes, Comm(), 1);
    std::vector<Vec3d> force, unused;
    (void)other.energy_and_forces(tissue, force);
    Vec3d sum, nucleus;
    for (const Vec3d& f : force) sum += f;
    for (const Vec3d& f : other.obstacle_forces(tissue)) sum += f;
    EXPECT_GT(norm(sum), 1.0) << "the nucleus is pushed";
    constexpr double h = 1e-5;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double energy[2];
      for (const int side : {0, 1}) {
        Tissue moved = tissue;
        (*moved.shells.nucleus[0])[axis] += side ? h : -h;
        other.bodies_changed();
        energy[side] = other.energy_and_forces(moved, unused);
      }
      nucleus[axis] = (energy[0] - energy[1]) / (2.0 * h);
    }
    other.bodies_changed();
    EXPECT_LT(norm(sum + nucleus), 1e-8 * other.obstacle_forces(tissue)[1].z);
  }
  run(*simulation, 600.0);
  EXPECT_GT(mechanics.interior_of(0).overlap, 0.01);
  EXPECT_LT(std::abs(imbalance()), 1e-5);
}

TEST(Nucleus, ComesWithAPromotionAndTravelsInARecord) {
  CellType type = clusters_model().types[0];
  type.interior.nucleus_fraction = 0.07;
  CellState row;
  row.id = CellId::founder(1);
  row.target_volume = kVolume;
  CellRecord cell{row, SphereRecord{{1, 2, 3}, kRadius, {}, {}}, std::nullopt};
  ShapeLibrary shapes;
  promote(cell, type, 0.0, 0.0, shapes, 1);
  ASSERT_TRUE(cell.shell->nucleus);
  EXPECT_LT(norm(*cell.shell->nucleus - Vec3d{1, 2, 3}), 1e-9);
  *cell.shell->nucleus += Vec3d{0.5, 0, 0};
  std::vector<std::byte> bytes;
  append_bytes(cell, bytes);
  Tissue tissue;
  put_together(tissue, read_records(bytes, shapes));
  ASSERT_NE(tissue.shells.nucleus_of(0), nullptr);
  EXPECT_EQ(*tissue.shells.nucleus_of(0), *cell.shell->nucleus);
  EXPECT_EQ(take_apart(tissue)[0].shell->nucleus, cell.shell->nucleus);
  demote(cell, type, 1.0);
  EXPECT_FALSE(cell.shell);
}

}  // namespace
}  // namespace morula
