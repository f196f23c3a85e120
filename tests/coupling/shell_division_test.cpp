// Shells that divide by cut: what daughters have of their mother, and what becomes of the surface between them.
#include "coupling/behaviours/shell_division.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/surroundings.h"
#include "coupling/swaps.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kRadius = 7.5;
const double kVolume = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;

class ShellDivision : public ::testing::Test {
 protected:
  ShellDivision() {
    type_ = test::clusters_model().types[0];
    shape_ = shapes_.icosphere(162).value();
    mother_ = spherical_shell(shape_, {3, -2, 1}, kVolume, 1.1 * kVolume);
    mother_.face.contact.assign(shape_->topology->face_count(), 0.25f);
  }
  std::array<dcm::ShellRecord, 2> divide(const Vec3d& axis, double share) {
    auto out = divide_shell({&mother_, {&type_, &type_}, shape_}, axis, share, {share * kVolume, (1.0 - share) * kVolume});
    EXPECT_TRUE(out.ok()) << out.error().message;
    return std::move(out).value();
  }
  static double volume(const dcm::ShellRecord& shell) {
    return enclosed_volume(shell.shape->topology->faces(), shell.position, {3, -2, 1});
  }

  CellType type_;
  ShapeLibrary shapes_;
  std::shared_ptr<const ReferenceShape> shape_;
  dcm::ShellRecord mother_;
};

/// Of a mother whose faces are in contact by a quarter: faces of the cap are in contact with the sister.
bool is_cap(const dcm::ShellRecord& shell, std::size_t f) { return shell.face.contact[f] == 1.0f; }

double face_area(const dcm::ShellRecord& shell, std::size_t f) {
  const auto& [a, b, c] = shell.shape->topology->faces()[f];
  return 0.5 * norm(cross(shell.position[b] - shell.position[a], shell.position[c] - shell.position[a]));
}

TEST_F(ShellDivision, SharesVolumeReferenceVolumeAndPressure) {
  for (const double share : {0.5, 0.3}) {
    const auto daughter = divide({0.3, 0.5, 1.0}, share);
    const double whole = volume(mother_);
    EXPECT_NEAR(volume(daughter[0]) / whole, share, 1e-12);
    EXPECT_NEAR((volume(daughter[0]) + volume(daughter[1])) / whole, 1.0, 1e-12);
    EXPECT_NEAR(daughter[0].reference_volume + daughter[1].reference_volume, mother_.reference_volume, 1e-12 * kVolume);
    for (const auto& shell : daughter) {
      const double pressure = -type_.shell.bulk_modulus * std::log(volume(shell) / shell.reference_volume);
      EXPECT_NEAR(pressure, -type_.shell.bulk_modulus * std::log(whole / mother_.reference_volume), 1e-11);
    }
    // The first lies where the axis points.
    const auto middle = [](const auto& shell) { return volume_centroid(shell.shape->topology->faces(), shell.position); };
    EXPECT_GT(dot(middle(daughter[0]) - middle(daughter[1]), Vec3d{0.3, 0.5, 1.0}), 0.0);
  }
}

TEST_F(ShellDivision, FacesOfTheCapTouchTheSisterAndCarryNoMark) {
  mother_.face.mark.assign(shape_->topology->face_count(), 1);
  const auto daughter = divide({0, 0, 1}, 0.5);
  for (const auto& shell : daughter) {
    double cap = 0.0, marked = 0.0, all = 0.0;
    const MarkSets marks(shell.face.mark, shell.shape->topology->face_count());
    for (std::size_t f = 0; f < marks.size(); ++f) {
      const double area = face_area(shell, f);
      all += area;
      if (is_cap(shell, f)) cap += area;
      if (marks.has(f, 0)) marked += area;
      EXPECT_FALSE(marks.has(f, 0) && is_cap(shell, f));
    }
    // The middle of a ball is cut across: a disk. The mesh of 162 nodes with the ball's volume reaches a little beyond it.
    EXPECT_NEAR(cap / (std::numbers::pi * kRadius * kRadius), 1.0, 0.05);
    EXPECT_NEAR((marked + cap) / all, 1.0, 0.02) << "what is not the cap has its mark";
  }
}

TEST_F(ShellDivision, CarriesTheRestLengthsOfTheOldPart) {
  // A mother stretched by 1.2 along z: a vector of the old part was shorter by what the metric says of its direction.
  for (Vec3d& x : mother_.position) x.z = 1.0 + 1.2 * (x.z - 1.0);
  const auto daughter = divide({1, 0, 0}, 0.5);
  for (const auto& shell : daughter) {
    const auto edges = shell.shape->topology->edges();
    double worst = 0.0, mean = 0.0;
    int old = 0, fresh = 0;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Edge& edge = edges[e];
      const Vec3d along = shell.position[edge.j] - shell.position[edge.i];
      const int caps = is_cap(shell, edge.left) + is_cap(shell, edge.right);
      if (caps == 1) continue;  // an edge of the rim lies on both
      const double expected = caps == 2 ? norm(along) : norm(Vec3d{along.x, along.y, along.z / 1.2});
      const double error = std::abs(shell.rest_length[e] / expected - 1.0);
      ++(caps == 2 ? fresh : old);
      worst = std::max(worst, error);
      mean += error;
    }
    EXPECT_GT(old, 150);
    EXPECT_GT(fresh, 50);
    EXPECT_LT(worst, 0.1);
    EXPECT_LT(mean / (old + fresh), 0.004);
  }
}

TEST_F(ShellDivision, RestLengthsGoToThoseOfAFreeCell) {
  type_.new_surface = 600.0;
  const auto daughter = divide({0, 0, 1}, 0.5);
  std::vector<CellType> types = {type_};
  Cells cells;
  cells.push_back(CellState());
  cells.rows[0].body = BodyKind::kShell;
  cells.rows[0].parent = CellId::founder(1);
  cells.rows[0].birth_time = 1000.0;
  const auto aged = [&](const std::vector<double>& steps) {
    dcm::Shells shells;
    dcm::add_shell(shells, daughter[0]);
    double time = 1000.0;
    for (const double dt : steps) renew_surfaces(types, cells, shells, time += dt, dt);
    return shells.rest_length;
  };
  const auto one = aged({300.0}), two = aged({60.0, 240.0}), whole = aged({300.0, 300.0}), beyond = aged({900.0});
  const double scale = std::cbrt(daughter[0].rest_volume);
  for (std::size_t e = 0; e < one.size(); ++e) {
    const double free = shape_->edge_length[e] * scale;
    EXPECT_NEAR(one[e], 0.5 * (free + daughter[0].rest_length[e]), 1e-12);
    EXPECT_NEAR(two[e], one[e], 1e-12) << "whatever the steps";
    EXPECT_DOUBLE_EQ(whole[e], free);
    EXPECT_DOUBLE_EQ(beyond[e], free);
  }
  types[0].shell.turnover_rate = 1e-3;
  EXPECT_EQ(aged({300.0}), daughter[0].rest_length) << "a cortex that turns over forgets by itself";
  types[0].shell.turnover_rate = 0.0;
  cells.rows[0].parent = CellId();
  EXPECT_EQ(aged({300.0}), daughter[0].rest_length) << "a founder has no new surface";
}

TEST_F(ShellDivision, AnInterfaceIsNewForATime) {
  CellRow row;
  row.birth_time = 1000.0;
  EXPECT_EQ(newness_of_surface(row, type_, 1000.0), 0.0) << "it has no mother";
  row.parent = CellId::founder(3);
  EXPECT_EQ(newness_of_surface(row, type_, 1000.0), 1.0);
  EXPECT_DOUBLE_EQ(newness_of_surface(row, type_, 1150.0), 0.75);
  EXPECT_EQ(newness_of_surface(row, type_, 1700.0), 0.0);
  type_.new_surface = 0.0;
  EXPECT_EQ(newness_of_surface(row, type_, 1000.0), 0.0) << "at once";
}

/// Energy of contact of two flat faces in touch is −W A, whatever the law: sisters adhere with W + n (2γ − W), others with W.
TEST_F(ShellDivision, SistersAdhereWithTwiceTheTensionAtFirst) {
  Model model = test::clusters_model(0.1);
  model.types[0].cycles = true;
  const auto energy = [&](CellId first, CellId second, double time) {
    Tissue tissue = test::make_tissue(model, shapes_, {{-6.05, 0, 0}, {6.05, 0, 0}}, std::vector<BodyKind>(2, BodyKind::kShell));
    const CellId ids[2] = {first, second};
    for (std::size_t k = 0; k < 2; ++k) {
      tissue.cells.rows[k].id = ids[k];
      tissue.cells.rows[k].parent = CellId::founder(9);
      tissue.cells.rows[k].birth_time = 0.0;
    }
    tissue.clock.time = time;
    Mechanics mechanics(model, {}, shapes_, Comm(), 1);
    std::vector<Vec3d> force;
    return mechanics.energy_and_forces(tissue, force);
  };
  const CellId mother = CellId::founder(9), other = CellId::founder(10);
  const double apart = energy(mother.daughter(0), other.daughter(1), 0.0);
  model.pairs[0].adhesion = 0.0;
  const double none = energy(mother.daughter(0), other.daughter(1), 0.0);
  model.pairs[0].adhesion = 0.1;
  const double of_w = apart - none;  // of W = 0.1
  EXPECT_LT(of_w, -0.01);
  const double tension = model.types[0].shell.tension;
  for (const double newness : {1.0, 0.5, 0.0}) {
    const double adhesion = 0.1 + newness * (2.0 * tension - 0.1);
    const double sisters = energy(mother.daughter(0), mother.daughter(1), (1.0 - newness) * model.types[0].new_surface);
    EXPECT_NEAR((sisters - none) / of_w, adhesion / 0.1, 1e-6) << newness;
  }
}

TEST_F(ShellDivision, NeighboursAreFoundThroughPeriodicFaces) {
  Model model = test::clusters_model();
  model.space.box = {{-20, -20, -20}, {20, 20, 20}};
  model.space.boundary[0] = {BoundaryKind::kPeriodic, BoundaryKind::kPeriodic};
  const Tissue tissue = test::make_tissue(model, shapes_, {{-19, 0, 0}, {-6.5, 0, 0}, {8.5, 0, 0}, {0, 19, 0}},
                                          std::vector<BodyKind>(4, BodyKind::kShell), 42);
  Scene scene;
  scene.build(tissue, model.space, 2.0, shapes_, Comm());
  const std::size_t first = 0;
  const Vec3d at = volume_centroid(tissue.shells.topology(first).faces(), tissue.shells.nodes(first));
  const Surroundings around = surroundings_of(scene, model.space, first, 2.0);
  for (const SurfaceView& surface : around.surfaces) {
    const Vec3d there = volume_centroid(surface.topology->faces(), surface.position);
    EXPECT_LT(norm(there - at), 15.0) << "where it is nearest";
  }
  const auto expected = static_cast<std::size_t>(at.x < -15.0 ? 2 : at.x > 8.0 ? 1 : at.y > 10.0 ? 0 : 1);
  EXPECT_EQ(around.surfaces.size(), expected);
}

}  // namespace
}  // namespace morula
