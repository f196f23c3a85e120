// A whole calibration of shells with default parameters, and one with a packing on ranks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "tests/system/calibrate_on_ranks.h"
#include "tests/system/found_law.h"
#include "tests/system/morula_command.h"
#include "tests/system/studies.h"

namespace morula::test {
namespace {

using testing::HasSubstr;

/// One command from a study to numbers and a report, with all of its experiments.
TEST(WholeCalibration, FindsALawOfShellsAndWritesAReport) {
  const TestFolder folder;
  folder.write("study.yaml", calibrated_study());
  const Outcome first =
      run_morula({"calibrate", "jkr", "small", "study.yaml", "--out", "found"}, folder.path(), {.timeout = std::chrono::seconds(800)});
  ASSERT_EQ(first.exit_code, 0) << first.all();
  expect_law_and_report(folder, calibrated_study(), first);
  EXPECT_THAT(read_text(folder.path() / "found" / "report.html"), HasSubstr("that two plates press flat"));
  EXPECT_THAT(read_text(folder.path() / "found" / "small.jkr.yaml"), HasSubstr("along the contact"));
}

/// With a packing, in which spheres come to rest for the fit.
TEST(CalibrateWithAPackingOnRanks, WritesTheSameFileOnRanksAndThreadsAndAfterASigkill) { expect_same_file_on_ranks("16 s"); }

}  // namespace
}  // namespace morula::test
