/// Clusters that touch nothing outside keep their centres in every step, at default tolerances; those that are held do not (decision 0024).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupling/mechanics/contact_setup.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

using B = BodyKind;

struct Cluster {
  Vec3d push;        ///< Σ d of its spheres: all have the same friction [µm]
  double way = 0.0;  ///< Σ |d| [µm]
};

/// Number of the sphere of a founder: cells lie along a curve.
std::size_t sphere_of(const Tissue& tissue, std::uint64_t founder) {
  const auto& rows = tissue.cells.rows;
  return static_cast<std::size_t>(
      std::find_if(rows.begin(), rows.end(), [&](const CellRow& row) { return row.id == CellId::founder(founder); }) - rows.begin());
}

/// Of these founders, all of them spheres.
Cluster way_of(const Tissue& before, const Tissue& after, std::initializer_list<std::uint64_t> founders) {
  Cluster out;
  for (const std::uint64_t founder : founders) {
    const std::size_t i = sphere_of(before, founder);
    const Vec3d d = after.spheres.position[i] - before.spheres.position[i];
    out.push += d;
    out.way += norm(d);
  }
  return out;
}

Mechanics mechanics_of(const Model& model, ShapeLibrary& shapes, int threads = 1) {
  return {model, contact_obstacles(model).value(), shapes, Comm(), threads};
}

TEST(FreeClusters, EachKeepsItsOwnCentreAndTheOneAtAWallDoesAlongIt) {
  Model model = test::clusters_model(0.02);
  model.space.box = {{-200, -200, -5.5}, {200, 200, 200}};
  model.space.boundary[2][0] = BoundaryKind::kWall;
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(
      model, shapes, {{0, 0, 50}, {11, 1, 50}, {5, 9, 51}, {-50, 0, 80}, {-50, 11.5, 80}, {60, 0, 0}, {60, 11, 1}, {90, 90, 90}},
      std::vector<B>(8, B::kSphere));
  tissue.obstacle_offset.resize(1);
  const Tissue before = tissue;
  Mechanics mechanics = mechanics_of(model, shapes);
  std::vector<Vec3d> external(Mechanics::external_size(tissue));
  external[sphere_of(tissue, 8)] = {0.1, 0.0, 0.0};
  const auto done = mechanics.step(tissue, 1.0, external);
  ASSERT_TRUE(done.ok()) << done.error().what;
  for (const auto& cluster : {way_of(before, tissue, {1, 2, 3}), way_of(before, tissue, {4, 5})}) {
    EXPECT_GT(cluster.way, 1e-4);
    EXPECT_LE(norm(cluster.push), 1e-6 * cluster.way);  // velocities are floats
  }
  const Cluster held = way_of(before, tissue, {6, 7});
  EXPECT_GT(norm(held.push), 1e-2 * held.way);  // the wall pushes
  EXPECT_LE(std::hypot(held.push.x, held.push.y), 1e-6 * held.way) << "across itself only";
  // Nothing but the medium: v = f/γ, γ = 4π R² γ_med.
  const double expected = 0.1 / (4.0 * std::numbers::pi * 36.0 * model.types[0].medium_friction);
  EXPECT_NEAR(way_of(before, tissue, {8}).push.x, expected, 1e-6 * expected);
}

TEST(FreeClusters, ShellsAndSpheresKeepTheirCommonCentre) {
  Model model = test::clusters_model(0.05);
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {11.8, 0.3, 0}, {5, 10.5, 1}, {5, 4, 11}},
                                    {B::kShell, B::kShell, B::kSphere, B::kSphere});
  Mechanics mechanics = mechanics_of(model, shapes);
  const std::vector<Vec3d> none(Mechanics::external_size(tissue));
  TissueMotion sum;
  for (int k = 0; k < 5; ++k) {
    const auto done = mechanics.step(tissue, 1.0, none);
    ASSERT_TRUE(done.ok()) << done.error().what;
    sum.drift += done->motion.drift;
    sum.way += done->motion.way;
  }
  EXPECT_GT(sum.way, 1e-3);
  EXPECT_LE(norm(sum.drift), 1e-3 * sum.way);
}

TEST(FreeClusters, AnisotropicFrictionWithTheMediumIsBalancedToo) {
  Model model = test::clusters_model(0.05);
  model.types[0].medium_normal_extra = 0.4;
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {11.8, 0.3, 0}}, {B::kShell, B::kShell});
  Mechanics mechanics = mechanics_of(model, shapes);
  std::vector<Vec3d> external(Mechanics::external_size(tissue));
  for (std::size_t i = 0; i < external.size(); ++i) external[i] = {0.0, 0.0, 0.01};
  const auto done = mechanics.step(tissue, 0.1, external);
  ASSERT_TRUE(done.ok()) << done.error().what;
  // Σ γ v = Σ f whatever the shape; the drift is in units of the mean friction, (γ_n + 2 γ_t)/3 per area.
  const double area = 2.0 * mechanics.values(tissue).area[0], per_area = (model.types[0].shell.medium_friction * 3.0 + 0.4) / 3.0;
  const double expected = 0.01 * static_cast<double>(external.size()) * 0.1 / (area * per_area);
  EXPECT_NEAR(done->motion.drift.z, expected, 0.01 * expected);  // the areas are those after the step
  EXPECT_LE(std::hypot(done->motion.drift.x, done->motion.drift.y), 1e-3 * expected);
}

}  // namespace
}  // namespace morula
