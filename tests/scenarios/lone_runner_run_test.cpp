/// The user's road to decision 0058: one cell that is pulled through others which rest. How long its steps are follows from how many the others are, where it
/// ends does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "results/series_reader.h"
#include "tests/scenarios/run_into.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr double kSpeed = 1.0 / (0.1 * 4.0 * std::numbers::pi * 36.0);  // of 1 nN against the medium, R = 6 µm [µm/s]
constexpr double kTime = 1800.0;                                        // [s]

/// `others`: resting cells 30 µm apart; nobody touches anybody.
std::string study_of(int others) {
  std::string places;
  for (int i = 0; i < others; ++i)
    places += (i == 0 ? "[" : ", [") + std::to_string(30 * (i % 10) - 135) + " um, " + std::to_string(30 * (i / 10 % 10) - 135) + " um, " +
              std::to_string(30 * (i / 100) - 135) + " um]";
  return "schema: 1\nstudy: runner\ntime: {end: 30 min, output: 30 min}\ndomain: {size: [400 um, 400 um, 400 um]}\n"
         "cell_types:\n  runner: {radius: 6 um, cycle: {model: none}}\n  other: {like: runner}\n"
         "initial:\n  - {type: runner, at: [[-20 um, 0 um, 0 um]]}\n" +
         (others > 0 ? "  - {type: other, at: [" + places + "]}\n" : std::string()) +
         "loads:\n  pull: {type: runner, body_force: [1 nN, 0 nN, 0 nN]}\noutput: {report: false}\n";
}

struct Ran {
  double steps = 0.0;
  double way = 0.0;  ///< of the runner [µm]
};

Ran run_with(int others) {
  const test::Folder folder;
  const auto study = test::read(study_of(others));
  EXPECT_TRUE(study.ok()) << (study.ok() ? "" : study.error().text());
  if (!study.ok()) return {};
  const std::filesystem::path out_folder = folder.path() / "run";
  test::run_into(out_folder, *study);
  const auto series = read_series(out_folder / "series.csv");
  EXPECT_TRUE(series.ok());
  if (!series.ok()) return {};
  // All weigh alike: the centre goes the runner's way over their number.
  return {series->find("step_count")->values.back(), series->find("centre_drift")->values.back() * (others + 1)};
}

/// Steps are to be 0.9 × 0.3 × 0.5 µm of what one of n counts, 1.7 n^(-1/4), between a third and the whole; they begin shorter.
TEST(LoneRunner, TakesLongerStepsAmongManyAndEndsAtTheSamePlace) {
  for (const int others : {0, 7, 99, 999}) {
    const Ran ran = run_with(others);
    const double counts = std::clamp(1.7 * std::pow(others + 1.0, -0.25), 1.0 / 3.0, 1.0);
    const double steps = kSpeed * kTime * counts / (0.9 * 0.3 * 0.5);
    EXPECT_NEAR(ran.steps, steps, 0.05 * steps + 6.0) << others;
    EXPECT_NEAR(ran.way, kSpeed * kTime, 1e-3 * kSpeed * kTime) << others;
  }
}

}  // namespace
}  // namespace morula::scenarios
