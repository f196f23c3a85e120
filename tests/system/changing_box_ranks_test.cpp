// The same bits on any number of threads and ranks and over a restart in the middle of the course of a box.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/runs_on_ranks.h"

namespace morula::test {
namespace {

using nlohmann::json;

/// Spheres and shells, those of a region and their neighbours over any border, that grow, divide, change their bodies and wander through the faces of a box that shrinks and widens.
constexpr const char* kStudy = R"(schema: 1
study: box
seed: 5
time: {end: 1 h, output: 10 min, checkpoint: 10 min}
domain:
  size: [44 um, 44 um, 44 um]
  boundary: periodic
  course: [{time: 5 min, volume: 1}, {time: 35 min, volume: 0.7}, {time: 50 min, volume: 0.7}, {time: 1 h, volume: 0.8}]
cell_types:
  cell:
    radius: {mean: 5 um, spread: 5 %}
    cycle: {duration: {mean: 3 h, spread: 10 %}}
    migration: {speed: 20 um/h, persistence: 10 min}
    dcm: {nodes: 42, nucleus: {kind: rigid, radius: 2 um}}
contact: {range: 1 um}
initial:
  - {type: cell, count: 50, fill: box, size: [44 um, 44 um, 44 um], start_volume: 60 %, inflate: 4 min, age: random}
coupling:
  regions:
    - {name: left, shape: half_space, center: [-10 um, 0 um, 0 um], normal: [1, 0, 0], as: dcm, margin: 2 um}
    - {name: next_to_it, shape: neighbours, of: left, cells: 1, as: dcm}
output: {report: false}
)";

// One test: the reference is run once.
TEST(ChangingBox, GivesTheSameBitsOnThreadsAndRanksAndOverARestartInItsCourse) {
  const TestFolder folder;
  folder.write("study.yaml", kStudy);
  const auto given_time = [](int ranks) { return on_ranks(ranks, std::chrono::seconds(400)); };
  const Outcome first = run_morula({"run", "study.yaml", "--out", "first"}, folder.path(), given_time(0));
  ASSERT_EQ(first.exit_code, 0) << first.all();
  const json reference = info_of(folder / "first");
  EXPECT_GT(reference["shells"].get<int>(), 5);
  EXPECT_GT(reference["spheres"].get<int>(), 5);
  EXPECT_GT(reference["cells"].get<int>(), 50) << "and divisions";
  const auto expect_same = [&](const std::string& run, const Outcome& outcome) {
    ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
    EXPECT_EQ(info_of(folder / run)["state_hash"], reference["state_hash"]) << run;
    EXPECT_EQ(read_text(folder / run / "series.csv"), read_text(folder / "first/series.csv")) << run;
  };
  expect_same("threads", run_morula({"run", "study.yaml", "--out", "threads", "--threads", "2"}, folder.path(), given_time(0)));
  for (const int ranks : {1, 2, 4}) {
    const std::string name = "ranks" + std::to_string(ranks);
    expect_same(name, run_morula({"run", "study.yaml", "--out", name}, folder.path(), given_time(ranks)));
  }
  // Stopped where the box is on its way.
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "two-one", "--until", "20 min"}, folder.path(), given_time(2)).exit_code, 0);
  expect_same("two-one", run_morula({"resume", "two-one"}, folder.path(), given_time(0)));
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "one-two", "--until", "20 min"}, folder.path(), given_time(0)).exit_code, 0);
  expect_same("one-two", run_morula({"resume", "one-two"}, folder.path(), given_time(2)));
}

}  // namespace
}  // namespace morula::test
