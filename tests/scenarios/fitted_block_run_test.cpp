// Spheres of a fitted law fill a box as the shells do from which it was found: the library's block, all of it spheres, from a study to its results.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "results/series_reader.h"
#include "scenarios/library/library.h"
#include "tests/scenarios/run_into.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

TEST(FittedBlock, OfSpheresBearsWhatShellsBearInDisorder) {
  const test::Folder folder;
  for (const TemplateFile& file : find_template("hybrid_block")->files) folder.write(std::string(file.path), std::string(file.content));
  ReadOptions options;
  options.overrides = {"coupling={}", "criteria=[]", "plots=[]", "output.report=false"};
  const auto study = read_study(folder.path() / "study.yaml", options);
  ASSERT_TRUE(study.ok()) << study.error().text();
  ASSERT_TRUE(test::run_into(folder.path() / "run", *study));
  const auto series = read_series(folder.path() / "run" / "series.csv");
  ASSERT_TRUE(series.ok()) << series.error().message;
  const SeriesColumn *time = series->find("time"), *pressure = series->find("box_pressure");
  ASSERT_TRUE(time != nullptr && pressure != nullptr);
  struct Rest {
    double time, shells, limit;  ///< [s], pressure of the block of shells alone [kPa], relative
  };
  // The block of shells (`cell_types.cell.body=shell coupling.regions=[]`), seeds 1 and 2: 149.3 and 149.5, 275.7 and 276.3, 414.7 and 415.2 Pa. Blocks of spheres of four seeds scatter by 3 %.
  for (const Rest& rest : {Rest{7200.0, 0.1494, 0.10}, Rest{12000.0, 0.2760, 0.05}, Rest{18000.0, 0.4149, 0.05}}) {
    const auto at = std::ranges::find_if(time->values, [&](double t) { return std::abs(t - rest.time) < 1e-6; });
    ASSERT_NE(at, time->values.end());
    EXPECT_NEAR(pressure->values[static_cast<std::size_t>(at - time->values.begin())] / rest.shells, 1.0, rest.limit) << rest.time;
  }
}

}  // namespace
}  // namespace morula::scenarios
