// The same bits on any number of ranks and over a restart for what acts on marked faces and by itself.
#include "tests/system/active_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/runs_on_ranks.h"

namespace morula::test {

std::string active_study() {
  return R"(schema: 1
study: active
seed: 5
time: {end: 90 s, output: 15 s, checkpoint: 30 s, step: 5 s}
domain: {size: [160 um, 160 um, 160 um], boundary: open}
contact:
  range: 1.2 um
  friction: objective
  pairs:
    - between: [wall, wall]
      regions: [{faces: [inner, any], adhesion: 2e-5 J/m^2}]
    - between: [crawler, floor]
      regions: [{faces: [front, any], adhesion: 2e-4 J/m^2}]
cell_types:
  wall:
    radius: 6 um
    adhesion: {wall: 1e-4 J/m^2, crawler: 5e-5 J/m^2, floor: 2e-5 J/m^2}
    friction: {medium: 1e8 N s/m^3, medium_tangential: 3e7 N s/m^3, cell_cell_tangential: 1e10 N s/m^3}
    fluctuations: {energy: 1e-17 J}
    dcm:
      nodes: 42
      self_contact: 200 nm
      cortex:
        tension: 0.3 mN/m
        lateral_easing: 20 s
        regions:
          inner: {tension: 0.5 mN/m, course: [{time: 20 s, factor: 1}, {time: 47 s, factor: 1.3}]}
          belt: {tension: 0.4 mN/m, amplitude: 30 %, period: 100 s}
          lateral: {tension: 0.2 mN/m}
  crawler:
    radius: 6 um
    adhesion: {crawler: 5e-5 J/m^2, floor: 1e-4 J/m^2}
    migration: {speed: 20 um/h, persistence: 10 min, substrate: floor}
    polarity: {turning: 5 1/h, follow_velocity: 5 min}
    protrusion: {force: 0.2 nN, substrate: floor, contact_area: 10 um^2}
    fluctuations: {energy: 1e-17 J}
    dcm: {nodes: 42, cortex: {tension: 0.3 mN/m}}
geometry:
  floor: {plane: {center: [0 um, 0 um, -30 um], normal: [0, 0, 1], size: 150 um}}
initial:
  - type: wall
    at: [[0 um, 6.23 um, 10.08 um], [0 um, -6.23 um, 10.08 um], [0 um, 6.23 um, -10.08 um], [0 um, -6.23 um, -10.08 um],
         [6.23 um, 10.08 um, 0 um], [-6.23 um, 10.08 um, 0 um], [6.23 um, -10.08 um, 0 um], [-6.23 um, -10.08 um, 0 um],
         [10.08 um, 0 um, 6.23 um], [-10.08 um, 0 um, 6.23 um], [10.08 um, 0 um, -6.23 um], [-10.08 um, 0 um, -6.23 um]]
    as: shell
  - {type: crawler, at: [[40 um, 0 um, -24.2 um], [52 um, 0 um, -24.2 um]], as: shell}
  - {type: crawler, at: [[40 um, 40 um, -24.2 um], [51 um, 40 um, -24.2 um], [60 um, 40 um, -10 um]], as: sphere}
marks:
  inner: {types: [wall], cone: {toward: [0 um, 0 um, 0 um], angle: 60 deg}}
  belt: {types: [wall, crawler], band: {axis: [0, 0, 1], half_width: 1.5 um}, when: always}
  front: {types: [crawler], cone: {polarity: true, angle: 40 deg}, when: always}
  floored: {types: [crawler], touched_by: {material: floor, keep: true}}
  low: {types: [wall], ball: {center: [0 um, 0 um, -12 um], radius: 8 um}}
lumens:
  cavity: {center: [0 um, 0 um, 0 um], pressure: 20 Pa, solute: kept, reach: 40 um, renewed: 20 s, from: 10 s}
apical:
  inside: {mark: inner, stiffness: 20 Pa/um, friction: 1e8 N s/m^3}
coupling:
  regions:
    - {name: late, shape: sphere, center: [60 um, 40 um, -10 um], radius: 10 um, as: shell, from: 40 s}
output: {report: false}
)";
}

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

CommandOptions given_time(int ranks) { return on_ranks(ranks, std::chrono::seconds(150)); }

TEST(ActiveTerms, AreTheSameBitsOnAnyNumberOfRanksAndOverARestart) {
  const TestFolder folder;
  folder.write("study.yaml", active_study());
  const Outcome first = run_morula({"run", "study.yaml", "--out", "first"}, folder.path(), given_time(0));
  ASSERT_EQ(first.exit_code, 0) << first.all();
  const json reference = info_of(folder / "first");
  EXPECT_EQ(reference["shells"].get<int>(), 15);
  const auto expect_same = [&](const std::string& run, const Outcome& outcome) {
    ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
    EXPECT_EQ(info_of(folder / run)["state_hash"], reference["state_hash"]) << run;
    EXPECT_EQ(read_text(folder / run / "series.csv"), read_text(folder / "first/series.csv")) << run;
  };
  for (const int ranks : {2, 4}) {
    const std::string name = "ranks" + std::to_string(ranks);
    expect_same(name, run_morula({"run", "study.yaml", "--out", name}, folder.path(), given_time(ranks)));
  }
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "two-one", "--until", "45 s"}, folder.path(), given_time(2)).exit_code, 0);
  expect_same("two-one", run_morula({"resume", "two-one"}, folder.path(), given_time(0)));
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "one-two", "--until", "45 s"}, folder.path(), given_time(0)).exit_code, 0);
  expect_same("one-two", run_morula({"resume", "one-two"}, folder.path(), given_time(2)));

  const Outcome vtk = run_morula({"export", "first", "vtk"}, folder.path(), given_time(0));
  ASSERT_EQ(vtk.exit_code, 0) << vtk.all();
  bool found = false;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    if (entry.path().filename() == "shells_000003.vtu") found = read_text(entry.path()).find("Name=\"mark front\"") != std::string::npos;
  EXPECT_TRUE(found) << vtk.all();
}

}  // namespace
}  // namespace morula::test
