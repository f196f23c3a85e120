/// Without a force from outside the friction-weighted centre of a tissue stays where it is: studies with default numerics, results read back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "results/series_reader.h"
#include "results/snapshot_file.h"
#include "scenarios/run/driver.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

std::string study(const std::string& initial, const std::string& end, const std::string& more = "") {
  return R"(schema: 1
study: free
seed: 3
time: {end: )" +
         end + ", output: " + end + R"(}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  cell: {radius: 6 um, friction: {obstacle_tangential: 0 N s/m^3}}
  small: {radius: 5 um}
)" + more +
         "initial:\n" + initial + "output: {report: false}\n";
}

struct Moved {
  double drift = 0.0, way = 0.0, rotation = 0.0;  // of series.csv
  double centre = 0.0, mean_way = 0.0;            // of the spheres' centres in results.h5, weighted by their surface
  Vec3d of_centre;                                // where it went
  double area[2] = {0.0, 0.0};                    // of all cells, there
};

/// Spheres have friction in proportion to their surface, which does not change here: their centre can be told from the snapshots alone.
Moved run_study(const std::string& text, const std::filesystem::path& folder) {
  Moved out;
  auto read = test::read(text, {}, folder);
  EXPECT_TRUE(read.ok()) << read.error().text();
  RunRequest request;
  request.out = folder / "run";
  const auto done = run(*read, request, Comm());
  EXPECT_TRUE(done.ok()) << done.error().message;
  const auto series = read_series(folder / "run/series.csv");
  EXPECT_TRUE(series.ok());
  out.drift = series->find("centre_drift")->values.back();
  out.way = series->find("mean_way")->values.back();
  out.rotation = series->find("rotation")->values.back();
  const auto first = read_snapshot(folder / "run/results.h5", 0), last = read_snapshot(folder / "run/results.h5", 1);
  EXPECT_TRUE(first.ok() && last.ok());
  Vec3d sum;
  double weight = 0.0;
  for (std::size_t i = 0; i < first->cells.size(); ++i) {
    const double radius = first->cells[i].radius, surface = radius * radius;
    const Vec3d way = last->cells[i].centroid - first->cells[i].centroid;
    sum += way * surface;
    out.mean_way += norm(way) * surface;
    weight += surface;
    out.area[0] += first->cells[i].area;
    out.area[1] += last->cells[i].area;
  }
  out.of_centre = sum * (1.0 / weight);
  out.centre = norm(out.of_centre);
  out.mean_way /= weight;
  return out;
}

constexpr double kMost = 1e-3;  // of the mean way: the mark of the issue, a hundredth of a typical error of the step size

TEST(Momentum, APairOfUnequalSpheresKeepsItsCentre) {
  const test::Folder folder;
  const Moved moved = run_study(study("  - {type: cell, at: [[-5.5 um, 0 um, 0 um]], as: cbm}\n"
                                      "  - {type: small, at: [[5 um, 1 um, 2 um]], as: cbm}\n",
                                      "1 h"),
                                folder.path());
  EXPECT_GT(moved.mean_way, 0.05);
  EXPECT_LE(moved.centre, kMost * moved.mean_way);
  EXPECT_LE(moved.drift, kMost * moved.way);
  EXPECT_NEAR(moved.drift, moved.centre, 1e-6);
  EXPECT_GE(moved.way, moved.mean_way - 1e-9);
}

TEST(Momentum, SixtySpheresKeepTheirCentre) {
  const test::Folder folder;
  // Placed without overlap, the cells hardly move; grown to twice their volume in half an hour they push each other outwards.
  const Moved moved =
      run_study(study("  - {type: cell, count: 60, fill: sphere, radius: 27 um, start_volume: 50 %, inflate: 30 min, as: cbm}\n", "1 h"),
                folder.path());
  EXPECT_GT(moved.mean_way, 1.0);
  EXPECT_LE(moved.centre, kMost * moved.mean_way);
  EXPECT_LE(moved.drift, kMost * moved.way);
}

TEST(Momentum, ThreeShellsKeepTheirCentre) {
  const test::Folder folder;
  const Moved moved = run_study(
      study("  - {type: cell, at: [[-6.05 um, 0 um, 0 um], [6.05 um, 0 um, 0 um], [0.1 um, 10.5 um, 1 um]], as: shell}\n", "20 min"),
      folder.path());
  EXPECT_GT(moved.way, 0.05);
  EXPECT_LE(moved.drift, kMost * moved.way);
}

TEST(Momentum, SpheresAndShellsKeepTheirCommonCentre) {
  const test::Folder folder;
  const Moved moved = run_study(study("  - {type: cell, at: [[-6.05 um, 0 um, 0 um], [6.05 um, 0 um, 0 um]], as: shell}\n"
                                      "  - {type: small, at: [[0 um, 9 um, 1 um], [1 um, -9 um, 0 um], [2 um, 1 um, 9 um]], as: cbm}\n",
                                      "20 min"),
                                folder.path());
  EXPECT_GT(moved.way, 0.05);
  EXPECT_LE(moved.drift, kMost * moved.way);
}

TEST(Momentum, AForceFromOutsideMovesTheCentreAsFrictionSays) {
  const test::Folder folder;
  const Moved moved =
      run_study(study("  - {type: cell, at: [[0 um, 0 um, 0 um]], as: shell, orientation: aligned}\n"
                      "  - {type: small, at: [[10 um, 1 um, 0 um], [0 um, 10 um, 1 um]], as: cbm}\n",
                      "5 min", "loads:\n  pull: {type: cell, patch: {force: [0 nN, 0 nN, 1 nN], toward: [0, 0, 1], part: 100 %}}\n"),
                folder.path());
  // F t/(γ Σ A), γ = 0.1 nN s/µm³; A is that of the snapshots, which the shell changes a little on the way.
  const double first = moved.area[0], last = moved.area[1];
  const double expected = 1.0 * 300.0 / (0.1 * 0.5 * (first + last));
  EXPECT_NEAR(moved.drift, expected, expected * (1e-4 + std::abs(last / first - 1.0)));
  EXPECT_LT(std::abs(last / first - 1.0), 0.02);
  EXPECT_GT(moved.rotation, 1e-3);  // it pulls beside the centre
}

/// A wall of the domain is flat and rubs nobody: along it nothing but the medium holds a cell, however hard it is pressed on.
/// A shell on the floor that 3 nN press onto it and 0.2 nN drag along it; nothing rubs but the medium.
void expect_slide(const std::string& floor) {
  const test::Folder folder;
  const std::string text = test::changed("domain: {size: [200 um, 200 um, 200 um]}", floor,
                                         study("  - {type: cell, at: [[-40 um, 0 um, -94 um]], as: shell}\n", "2 h",
                                               "loads:\n  drag: {type: cell, body_force: [0.2 nN, 0 nN, -3 nN]}\n"));
  const Moved moved = run_study(text, folder.path());
  const double way = 0.2 * 7200.0 / 0.1;  // F t/γ, over the area: that of the round cell at the start, a little more of the flat one
  EXPECT_GT(moved.area[1], 1.01 * moved.area[0]);
  EXPECT_LT(moved.centre, 1.001 * way / moved.area[0]);
  EXPECT_GT(moved.centre, 0.999 * way / moved.area[1]);
}

TEST(Momentum, APressedShellSlidesAlongAWallAsFrictionSays) {
  expect_slide("domain: {size: [200 um, 200 um, 200 um], boundary: {z_low: wall}}");
}

TEST(Momentum, APressedShellSlidesAlongAnObstacleThatDoesNotRub) {
  expect_slide(
      "domain: {size: [200 um, 200 um, 200 um]}\n"
      "geometry: {glass: {plane: {center: [0 um, 0 um, -100 um], size: 190 um}}}");
}

TEST(Momentum, SpheresOnAWallKeepTheirCentreAlongIt) {
  const test::Folder folder;
  const Moved moved = run_study(test::changed("size: [200 um, 200 um, 200 um]", "size: [200 um, 200 um, 200 um], boundary: {z_low: wall}",
                                              study("  - {type: cell, at: [[-5.5 um, 0 um, -94.1 um], [2 um, 9 um, -94.1 um]], as: cbm}\n"
                                                    "  - {type: small, at: [[5 um, 1 um, -95.1 um]], as: cbm}\n",
                                                    "1 h", "loads:\n  weight: {type: cell, body_force: [0 nN, 0 nN, -1 nN]}\n")),
                                folder.path());
  EXPECT_GT(moved.mean_way, 0.05);
  EXPECT_LE(std::hypot(moved.of_centre.x, moved.of_centre.y), kMost * moved.mean_way);
}

}  // namespace
}  // namespace morula::scenarios
