/// The user's road to the volumes of daughters: they have grown since their birth within the step when a row is written.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "results/series_reader.h"
#include "tests/scenarios/run_into.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr const char* kStudy = R"(
schema: 1
study: newborn
time: {end: 6 h, output: 2 min}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  cell: {radius: 5 um, cycle: {duration: {mean: 2 h, spread: 10 %}}}
initial:
  - {type: cell, count: 5, fill: sphere, radius: 15 um}
output: {report: false}
)";

TEST(NewbornVolume, IsThatOfTheirLawInEveryRow) {
  const test::Folder folder;
  const auto study = test::read(kStudy);
  ASSERT_TRUE(study.ok()) << study.error().text();
  ASSERT_TRUE(test::run_into(folder.path() / "run", *study));
  const auto series = read_series(folder.path() / "run" / "series.csv");
  ASSERT_TRUE(series.ok());
  EXPECT_GE(series->find("cell_count")->values.back(), 25.0);  // every step ends at a row, and many of them with a division
  EXPECT_LT(std::ranges::max(series->find("volume_error")->values), 1e-12);
}

}  // namespace
}  // namespace morula::scenarios
