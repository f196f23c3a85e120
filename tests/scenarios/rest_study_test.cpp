// `time.rest` through study files with default parameters: runs end when nothing is left to happen, and not before.
#include <gtest/gtest.h>

#include <numbers>

#include "results/series_reader.h"
#include "scenarios/run/driver.h"
#include "tests/results/results_support.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr const char* kAsleep = R"(schema: 1
study: asleep
time: {end: 2 h, output: 5 min, rest: 1 um/h}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  cell: {radius: 6 um, dcm: {nodes: 42}}
contact: {range: 1 um}
initial:
  - {type: cell, at: [[-20 um, 0 um, 0 um], [20 um, 0 um, 0 um]]}
output: {report: false}
)";

class Rest : public ::testing::Test {
 protected:
  double end_of(const std::string& text) {
    const auto study = test::read(text, {}, folder_.path());
    EXPECT_TRUE(study.ok()) << study.error().text();
    if (!study.ok()) return -1.0;
    RunRequest request;
    request.out = folder_.path() / ("run_" + std::to_string(++runs_));
    request.command = "a test";
    const auto done = run(*study, request, Comm());
    EXPECT_TRUE(done.ok()) << done.error().message;
    if (!done.ok()) return -1.0;
    series_ = read_series(request.out / "series.csv").value();
    log_ = testing_support::slurp(request.out / "log.txt");
    return done->final_state.time;
  }

  test::Folder folder_;
  int runs_ = 0;
  SeriesTable series_;
  std::string log_;
};

TEST_F(Rest, ComesAtTheFirstOutputWhereNothingHappens) {
  EXPECT_EQ(end_of(kAsleep), 300.0);
  EXPECT_EQ(log_.find("still to come"), std::string::npos);
}

/// Cells that grow to their whole volume over 40 min move by less than 1 µm/h: the run waits for them, and says so.
TEST_F(Rest, WaitsForCellsThatInflate) {
  const std::string at = "[20 um, 0 um, 0 um]]";
  for (const char* body : {"sphere", "shell"}) {
    EXPECT_EQ(end_of(test::changed(at, at + ", as: " + body + ", start_volume: 80 %, inflate: 40 min", kAsleep)), 2400.0) << body;
    const double volume = 2.0 * 4.0 / 3.0 * std::numbers::pi * 216.0;
    EXPECT_NEAR(series_.find("total_volume")->values.back() / volume, 1.0, 0.02) << body;
    EXPECT_NE(log_.find("nothing moves, but there is still to come: inflation"), std::string::npos) << log_;
  }
}

TEST_F(Rest, WaitsForRegionsAndWhatTheyDo) {
  const std::string region = "coupling:\n  regions:\n    - {name: late, shape: sphere, radius: 50 um, as: shell, from: 22 min}\noutput:";
  const double end = end_of(test::changed("output: {", region + " {", kAsleep));
  EXPECT_GE(end, 22.0 * 60.0);
  EXPECT_LT(end, 7200.0);
  EXPECT_EQ(series_.find("shell_count")->values.back(), 2.0);
}

TEST_F(Rest, NeverComesWhereCellsGrow) {
  EXPECT_EQ(end_of(test::changed("radius: 6 um,", "radius: 6 um, cycle: {duration: 400 h},", test::changed("2 h", "20 min", kAsleep))),
            1200.0);
}

}  // namespace
}  // namespace morula::scenarios
