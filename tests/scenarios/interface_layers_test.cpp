#include "scenarios/measures/interface_layers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "results/file_io.h"
#include "results/snapshot_file.h"
#include "scenarios/criteria/judge_criteria.h"
#include "scenarios/run/driver.h"
#include "scenarios/run/interface_table.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr double kSpacing = 9.5, kRadius = 5.0;
constexpr int kLong = 8, kWide = 3;

/// Cells on a cubic lattice, 8 planes along x: four of spheres, four of shells. The pressure of a plane is 1 kPa times its number; beside that of the first
/// cell of a plane, which is 9 kPa less than that, and the last, which is 9 kPa more.
Snapshot lattice(const Vec3d& shift, double time) {
  Snapshot out;
  out.time = time;
  std::uint32_t id = 1;
  for (int x = 0; x < kLong; ++x)
    for (int y = 0; y < kWide; ++y)
      for (int z = 0; z < kWide; ++z) {
        Snapshot::Cell cell;
        cell.id = CellId::founder(id++);
        cell.body = x < kLong / 2 ? BodyKind::kSphere : BodyKind::kShell;
        cell.centroid = Vec3d{x - 0.5 * (kLong - 1), y - 1.0, z - 1.0} * kSpacing + shift;
        cell.radius = kRadius;
        cell.area = 300.0, cell.contact_area = x < kLong / 2 ? 75.0 : 150.0;
        cell.volume = 500.0;
        cell.pressure = x + (y == 0 && z == 0 ? -9.0 : y == 2 && z == 2 ? 9.0 : 0.0);
        out.cells.push_back(cell);
      }
  return out;
}

Space box(bool periodic) {
  Space space;
  const Vec3d half{0.5 * kLong * kSpacing, 50.0, 50.0};
  space.box = {Vec3d{} - half, half};
  if (periodic) space.boundary[0] = {BoundaryKind::kPeriodic, BoundaryKind::kPeriodic};
  return space;
}

TEST(InterfaceLayers, GoFromTheFarthestSpheresToTheFarthestShells) {
  const auto layers = interface_layers(lattice({-3, 0, 4}, 0.0), lattice({0, -2, 0}, 6.0), lattice({0, 0, 0}, 10.0), box(false));
  ASSERT_EQ(layers.size(), 8u);
  for (int k = 0; k < 8; ++k) {
    const InterfaceLayer& one = layers[static_cast<std::size_t>(k)];
    EXPECT_EQ(one.body, k < 4 ? BodyKind::kSphere : BodyKind::kShell);
    EXPECT_EQ(one.number, k < 4 ? 4 - k : k - 3);
    EXPECT_EQ(one.and_beyond, k == 0 || k == 7);
    EXPECT_EQ(one.cells, 9u);
    EXPECT_NEAR(one.pressure.mean, k, 1e-12);
    EXPECT_NEAR(one.pressure.error, 1.5, 1e-12);  // deviation sqrt(2·81/8) = 4.5, over sqrt(9)
    EXPECT_NEAR(one.contact_part.mean, k < 4 ? 0.25 : 0.5, 1e-12);
    EXPECT_NEAR(one.way.mean, 5.0, 1e-12);
    EXPECT_NEAR(one.speed.mean, 0.5, 1e-12);
  }
  const LayerMean p = jump(layers, &InterfaceLayer::pressure);
  EXPECT_NEAR(p.mean, 1.0, 1e-12);
  EXPECT_NEAR(p.error, std::sqrt(2.0) * 1.5, 1e-12);
}

TEST(InterfaceLayers, MeetAcrossAPeriodicBorderToo) {
  const Snapshot now = lattice({0, 0, 0}, 10.0);
  const auto layers = interface_layers(lattice({70, 0, 0}, 0.0), now, now, box(true));
  ASSERT_EQ(layers.size(), 4u);  // two planes of each body at an interface, two behind them
  for (const InterfaceLayer& one : layers) EXPECT_EQ(one.cells, 18u);
  EXPECT_NEAR(layers[1].pressure.mean, 1.5, 1e-12);  // planes 0 and 3
  EXPECT_NEAR(layers[0].pressure.mean, 1.5, 1e-12);  // planes 1 and 2
  EXPECT_NEAR(layers[0].way.mean, kLong * kSpacing - 70.0, 1e-12) << "the shorter way, around";
  EXPECT_TRUE(std::isnan(layers[0].speed.mean)) << "no time has passed";
}

TEST(InterfaceLayers, AreNoneWhereBodiesDoNotMeet) {
  Snapshot apart = lattice({0, 0, 0}, 1.0);
  for (Snapshot::Cell& cell : apart.cells)
    if (cell.body == BodyKind::kShell) cell.centroid.x += 3.0;  // 12.5 µm between the planes, 12 is what touches
  EXPECT_TRUE(interface_layers(apart, apart, apart, box(false)).empty());
  Snapshot spheres = lattice({0, 0, 0}, 1.0);
  for (Snapshot::Cell& cell : spheres.cells) cell.body = BodyKind::kSphere;
  EXPECT_TRUE(interface_layers(spheres, spheres, spheres, box(false)).empty());
  EXPECT_TRUE(std::isnan(jump({}, &InterfaceLayer::pressure).mean));
}

TEST(InterfaceTable, HasARowForEachLayerAndTheJump) {
  const auto study = test::read(
      "schema: 1\nstudy: s\ntime: {end: 1 h}\ndomain: {size: [100 um, 100 um, 100 um]}\ncell_types: {cell: {radius: 5 um}}\n"
      "initial: [{type: cell, at: [[0 um, 0 um, 0 um]]}]\n");
  ASSERT_TRUE(study.ok()) << study.error().text();
  const auto table = interface_table(*study, {lattice({0, 0, 1}, 0.0), lattice({0, 0, 0}, 3600.0)});
  ASSERT_TRUE(table.has_value());
  ASSERT_EQ(table->rows.size(), 9u);
  EXPECT_EQ(table->rows[3],
            (std::vector<std::string>{"spheres that touch shells", "9", "3000 ± 1500", "25 ± 0", "500 ± 0", "1 ± 0", "1 ± 0"}));
  EXPECT_EQ(table->rows[8][2], "1000 ± 2121");
  EXPECT_FALSE(interface_table(*study, {lattice({0, 0, 0}, 0.0)}).has_value());
}

/// From a study file with default parameters to what the run writes: the criterion finds the difference of the two cells of the results, and the report has the layers.
TEST(InterfaceReport, OfARunTellsTheJumpBetweenASphereAndAShellThatTouch) {
  const test::Folder folder;
  ReadOptions options;
  options.check_criteria = &check_criteria;
  const auto study = test::read(
      "schema: 1\nstudy: two\ntime: {end: 10 min, output: 5 min}\ndomain: {size: [100 um, 100 um, 100 um]}\ncell_types: {cell: {radius: 6 "
      "um}}\n"
      "initial:\n  - {type: cell, at: [[-5.7 um, 0 um, 0 um]]}\n  - {type: cell, at: [[5.7 um, 0 um, 0 um]], as: shell}\n"
      "criteria: [{id: JUMP, measure: interface.pressure_jump, between: [-1 kPa, 1 kPa]}]\n",
      options);
  ASSERT_TRUE(study.ok()) << study.error().text();
  RunRequest request;
  request.out = folder.path() / "run";
  const auto done = run(*study, request, Comm());
  ASSERT_TRUE(done.ok()) << done.error().message;
  const auto entries = list_snapshots(folder.path() / "run/results.h5");
  ASSERT_TRUE(entries.ok());
  const auto end = read_snapshot(folder.path() / "run/results.h5", entries->back().index);
  ASSERT_TRUE(end.ok());
  double of_sphere = 0.0, of_shell = 0.0;
  for (const Snapshot::Cell& cell : end->cells) (cell.body == BodyKind::kShell ? of_shell : of_sphere) = cell.pressure;
  const auto verdict = std::ranges::find(done->verdicts, "JUMP", &Verdict::id);
  ASSERT_NE(verdict, done->verdicts.end());
  EXPECT_NE(of_shell, of_sphere);
  EXPECT_NEAR(verdict->value, of_shell - of_sphere, 1e-12);
  const auto report = read_file(folder.path() / "run/report.html");
  ASSERT_TRUE(report.ok());
  for (const char* text :
       {"Where spheres and shells meet", "spheres that touch shells", "shells that touch spheres", "jump: shells less spheres"})
    EXPECT_NE(report->find(text), std::string::npos) << text;
}

}  // namespace
}  // namespace morula::scenarios
