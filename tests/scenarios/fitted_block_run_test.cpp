// Spheres of a fitted law fill a box as the shells do from which it was found: the library's block, all of it spheres, from a study to its results.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "results/series_reader.h"
#include "scenarios/library/library.h"
#include "tests/scenarios/run_into.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

/// Pressure of the block at rest at V/V0 0.95, 0.90 and 0.85, all of it spheres [kPa]; empty where something failed.
std::vector<double> pressures_of_block(const std::string& seed) {
  const test::Folder folder;
  for (const TemplateFile& file : find_template("hybrid_block")->files) folder.write(std::string(file.path), std::string(file.content));
  ReadOptions options;
  options.overrides = {"coupling={}", "criteria=[]", "plots=[]", "output.report=false", "seed=" + seed};
  const auto study = read_study(folder.path() / "study.yaml", options);
  if (!study.ok()) return ADD_FAILURE() << study.error().text(), std::vector<double>();
  EXPECT_TRUE(test::run_into(folder.path() / "run", *study));
  const auto series = read_series(folder.path() / "run" / "series.csv");
  if (!series.ok()) return ADD_FAILURE() << series.error().message, std::vector<double>();
  const SeriesColumn *time = series->find("time"), *pressure = series->find("box_pressure");
  std::vector<double> out;
  for (const double rest : {7200.0, 12000.0, 18000.0}) {
    const auto at = std::ranges::find_if(time->values, [&](double t) { return std::abs(t - rest) < 1e-6; });
    if (at != time->values.end()) out.push_back(pressure->values[static_cast<std::size_t>(at - time->values.begin())]);
  }
  return out;
}

TEST(FittedBlock, OfSpheresBearsWhatShellsBearInDisorder) {
  std::vector<double> mean(3, 0.0);
  for (const char* seed : {"1", "2", "3", "4"}) {
    const std::vector<double> of_seed = pressures_of_block(seed);
    ASSERT_EQ(of_seed.size(), mean.size());
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += of_seed[k] / 4.0;
  }
  // The block of shells (`cell_types.cell.body=shell coupling={}`), seeds 1 and 2: 149.3 and 149.5, 275.7 and 276.3, 414.7 and 415.2 Pa. Of spheres single
  // seeds scatter by 5 % at 0.95 and 1.5 % below.
  const double shells[] = {0.1494, 0.2760, 0.4149}, limit[] = {0.07, 0.03, 0.03};
  for (std::size_t k = 0; k < mean.size(); ++k) EXPECT_NEAR(mean[k] / shells[k], 1.0, limit[k]) << k;
}

}  // namespace
}  // namespace morula::scenarios
