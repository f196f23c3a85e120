/// Studies whose spheres leave the range of their laws: the columns that tell it, and cells that become shells for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "cbm/sphere_range.h"
#include "results/file_io.h"
#include "results/run_record.h"
#include "results/series_reader.h"
#include "results/snapshot_file.h"
#include "scenarios/run/driver.h"
#include "tests/scenarios/simulation_of.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

std::string study_of(const std::string& time, const std::string& type, const std::string& initial, const std::string& more = "") {
  return "schema: 1\nstudy: range\nseed: 1\ntime: " + time +
         "\ndomain: {size: [200 um, 200 um, 200 um]}\ncell_types:\n  cell: {radius: 6 um, cycle: {model: none}" + type +
         "}\ninitial:\n  - {type: cell, " + initial + "}\n" + more + "output: {report: false}\n";
}

/// The folder of a run of this study, which ends well.
void run_in(const test::Folder& folder, const std::string& text, const std::string& name) {
  const auto study = test::read(text);
  ASSERT_TRUE(study.ok()) << study.error().text();
  RunRequest request;
  request.out = folder.path() / name;
  request.command = "a test";
  const auto done = run(*study, request, Comm());
  ASSERT_TRUE(done.ok()) << done.error().message;
}

double last_of(const std::filesystem::path& run, const char* column) {
  const auto series = read_series(run / "series.csv");
  EXPECT_TRUE(series.ok());
  return series->find(column)->values.back();
}

/// a_0 = (9πWR*²/(2E*))^{1/3} of two default spheres of 6 µm is 0.404 R (decision 0027), and the range ends at 0.45 R.
TEST(OutsideLaw, OfTwoSpheresAtRestIsTheSquareOfTheirContactRadiusOverItsRange) {
  const test::Folder folder;
  run_in(folder, study_of("{end: 2 h, output: 1 h}", "", "at: [[0 um, 0 um, 0 um], [11.4 um, 0 um, 0 um]]"), "pair");
  const double modulus = 1.5 / (2.0 * (1.0 - 0.16));
  const double contact = std::cbrt(4.5 * std::numbers::pi * 0.1 * 9.0 / modulus);
  const double expected = std::pow(contact / (0.45 * 6.0), 2);
  const auto entries = list_snapshots(folder.path() / "pair/results.h5");
  ASSERT_TRUE(entries.ok());
  const auto snapshot = read_snapshot(folder.path() / "pair/results.h5", entries->back().index);
  ASSERT_TRUE(snapshot.ok()) << snapshot.error().message;
  const auto outside = std::ranges::find(snapshot->variables, "outside_law", &Snapshot::Variable::name);
  ASSERT_NE(outside, snapshot->variables.end());
  ASSERT_EQ(outside->values.size(), 2u);
  for (const double value : outside->values) EXPECT_NEAR(value, expected, 2e-3);  // what is left of the way to rest
  EXPECT_NEAR(last_of(folder.path() / "pair", "mean_outside_law"), expected, 2e-3);
  EXPECT_EQ(last_of(folder.path() / "pair", "spheres_outside_law"), 0.0);
}

/// A cell is told the same whatever its body is, as long as nobody has moved: else exchanges of bodies would follow from exchanges of bodies.
TEST(OutsideLaw, DoesNotDependOnTheBodies) {
  const std::string places = "at: [[0 um, 0 um, 0 um], [11 um, 0 um, 0 um], [5 um, 9.6 um, 0 um], [5.5 um, 3 um, 9 um]]";
  const std::string walls = "geometry: {floor: {plane: {center: [0 um, 0 um, -5.5 um], normal: [0, 0, 1], size: 120 um}}}\n";
  std::map<std::string, std::vector<double>> found, caps;
  for (const std::string body : {"sphere", "shell"}) {
    const auto study = test::read(study_of("{end: 1 h}", "", places + ", as: " + body, walls + "numerics: {start_cap: 0.2 um}\n"));
    ASSERT_TRUE(study.ok()) << study.error().text();
    auto simulation = test::simulation_of(*study);
    ASSERT_TRUE(simulation.ok());
    (*simulation)->mechanics().attach(const_cast<Tissue&>((*simulation)->tissue()));
    const AsBalls balls = (*simulation)->mechanics().as_balls((*simulation)->tissue());
    found[body] = balls.outside_law, caps[body] = balls.caps;
  }
  ASSERT_EQ(found["sphere"].size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GT(found["sphere"][i], 0.9) << i;
    EXPECT_NEAR(found["shell"][i], found["sphere"][i], 1e-9) << i;
    EXPECT_NEAR(caps["shell"][i], caps["sphere"][i], 1e-9 * caps["sphere"][i]) << i;
  }
}

/// A spheroid between plates that come nearer: cells whose contacts leave the range of their law become shells.
TEST(OutsideLaw, TriggerLeavesFewerSpheresOutsideInAPressedSpheroid) {
  const test::Folder folder;
  const std::string plates =
      "geometry:\n  floor: {plane: {center: [0 um, 0 um, -19 um], normal: [0, 0, 1], size: 150 um}}\n"
      "  lid:\n    plane: {center: [0 um, 0 um, 19 um], normal: [0, 0, -1], size: 150 um}\n"
      "    motion: {direction: [0, 0, -1], course: [{time: 10 min, distance: 0 um}, {time: 40 min, distance: 14 um}]}\ncontact: {range: "
      "1.2 um}\n";
  const auto text = [&](const std::string& coupling) {
    return study_of("{end: 1 h, output: 10 min}", ", dcm: {nodes: 42}", "count: 30, fill: sphere, radius: 20 um", plates + coupling);
  };
  run_in(folder, text(""), "without");
  run_in(folder, text("coupling: {triggers: [{outside_law: 1.0, hold: 5 min}]}\n"), "with");
  const double without = last_of(folder.path() / "without", "spheres_outside_law"),
               with = last_of(folder.path() / "with", "spheres_outside_law"), spheres = last_of(folder.path() / "with", "sphere_count");
  EXPECT_GT(without, 0.3);
  EXPECT_EQ(std::isnan(with), spheres == 0.0) << "of no sphere nothing is told";
  EXPECT_LT(spheres > 0.0 ? with * spheres : 0.0, 0.5 * without * 30.0);
  EXPECT_GT(last_of(folder.path() / "with", "promotions"), 5.0);
  EXPECT_LE(last_of(folder.path() / "with", "demotions"), 0.2 * last_of(folder.path() / "with", "promotions"))
      << "they do not go back and forth";
}

/// Held at the threshold, cells do not change their bodies again and again: what a shell is told is what it would be as a sphere.
TEST(OutsideLaw, DoesNotFlapAtTheThreshold) {
  const auto text = [](double threshold) {
    return study_of("{end: 8 h, step: 20 s}", ", dcm: {nodes: 42}",
                    "at: [[0 um, 0 um, 0 um], [11.35 um, 0 um, 0 um], [5.67 um, 9.83 um, 0 um]]",
                    "contact: {range: 1.2 um}\ncoupling: {triggers: [{promote: outside_law > " + std::to_string(threshold) +
                        ", demote: outside_law < " + std::to_string(0.99 * threshold) + ", hold: 1 min}]}\n");
  };
  const auto at_rest = test::read(text(50.0));
  ASSERT_TRUE(at_rest.ok()) << at_rest.error().text();
  auto calm = test::simulation_of(*at_rest);
  ASSERT_TRUE(calm.ok());
  while ((*calm)->tissue().clock.time < 3600.0) ASSERT_TRUE((*calm)->step(3600.0).ok());
  const double rest = (*calm)->mechanics().as_balls((*calm)->tissue()).outside_law[0];
  const auto study = test::read(text(0.999 * rest));
  ASSERT_TRUE(study.ok()) << study.error().text();
  auto made = test::simulation_of(*study);
  ASSERT_TRUE(made.ok());
  ASSERT_TRUE((*made)->first_swaps().ok());
  while ((*made)->tissue().clock.time < 8.0 * 3600.0) ASSERT_TRUE((*made)->step(8.0 * 3600.0).ok());
  EXPECT_GE((*made)->tissue().clock.steps, 1000u);
  const Ledger& ledger = (*made)->tissue().ledger;
  EXPECT_GE(ledger.promotions, 1u);
  EXPECT_LE(ledger.promotions + ledger.demotions, 6u) << ledger.promotions << " promotions, " << ledger.demotions << " demotions";
}

/// A small sphere on a large shell that it adheres to is no contact of two spheres: the log tells it all the same.
TEST(OutsideLaw, OfASphereOnAShellIsToldInTheLog) {
  const test::Folder folder;
  run_in(folder, R"(schema: 1
study: on_a_shell
time: {end: 30 min, output: 15 min}
domain: {size: [60 um, 60 um, 60 um]}
cell_types:
  big: {radius: 12 um, body: shell, adhesion: {big: 1e-4 J/m^2, small: 1e-4 J/m^2}}
  small: {radius: 3 um, adhesion: {small: 1e-5 J/m^2}}
initial:
  - {type: big, at: [0 um, 0 um, 0 um]}
  - {type: small, at: [15.2 um, 0 um, 0 um]}
output: {report: false}
)",
         "run");
  EXPECT_GT(last_of(folder.path() / "run", "max_outside_law"), 1.0);
  EXPECT_THAT(read_file(folder.path() / "run/log.txt").value(), testing::HasSubstr("1 of 1 spheres are outside the range of their law"));
}

TEST(OutsideLaw, TriggersAreCheckedLikeOthers) {
  const auto errors = [](const std::string& trigger) {
    const auto study = test::read(study_of("{end: 1 h}", "", "at: [[0 um, 0 um, 0 um]]", "coupling: {triggers: [" + trigger + "]}\n"));
    return study.ok() ? std::string() : study.error().text();
  };
  EXPECT_EQ(errors("{promote: outside_law > 1, demote: outside_law < 0.9}"), "");
  EXPECT_THAT(errors("{promote: outside_law > 1, demote: outside_law < 1.1}"), testing::HasSubstr("[E501]"));
  EXPECT_THAT(errors("{promote: outside_law > 1 kPa, demote: outside_law < 0.9}"), testing::HasSubstr("outside_law"));
}

}  // namespace
}  // namespace morula::scenarios
