#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "tests/system/found_law.h"
#include "tests/system/morula_command.h"
#include "tests/system/studies.h"

namespace morula::test {
namespace {

using testing::HasSubstr;

constexpr std::chrono::seconds kLong(800);

/// One command from a study to numbers and a report. Friction along the contact, packings that are held out and shells with default parameters:
/// calibrate_slow_test.cpp.
TEST(Calibrate, FindsALawOfShellsAndWritesAReport) {
  const TestFolder folder;
  const std::string study =
      changed(changed(calibrated_study(), "boundary: open}\n", "boundary: open}\ncontact: {range: 1.2 um, repulsion: 20 kPa/um}\n"),
              "dcm: {nodes: 42}",
              "friction: {cell_cell_tangential: 0 N s/m^3}, adhesion: {small: 0.03 mN/m}, dcm: {nodes: 42, cortex: {young: 0.3 kPa, "
              "tension: 0.3 mN/m}}");
  folder.write("study.yaml", study);
  const Outcome first =
      run_morula({"calibrate", "jkr", "small", "study.yaml", "--budget", "80 s", "--out", "found"}, folder.path(), {.timeout = kLong});
  ASSERT_EQ(first.exit_code, 0) << first.all();
  EXPECT_THAT(first.err, HasSubstr("no time for packing_fcc, packing_bcc, unequal_pair_3, packing_random_3\n"));
  expect_law_and_report(folder, study, first);
}

TEST(Calibrate, LeavesOutWhatItsBudgetHasNoTimeFor) {
  const TestFolder folder;
  folder.write("study.yaml", calibrated_study());
  const auto within = [&](const char* budget) {
    return run_morula({"calibrate", "jkr", "small", "study.yaml", "--budget", budget, "--out", "short"}, folder.path(), {.timeout = kLong});
  };
  const Outcome too_small = within("1 ms");
  EXPECT_EQ(too_small.exit_code, 2) << too_small.all();
  EXPECT_THAT(too_small.err, HasSubstr("is too small for any fit: two cells at two rates alone take about 3 s of one core"));
  const Outcome done = within("3 s");
  ASSERT_EQ(done.exit_code, 0) << done.all();
  const Outcome again = within("3 s");
  EXPECT_EQ(again.exit_code, 0) << again.all();
  EXPECT_EQ(again.out, done.out);
  EXPECT_THAT(done.err, HasSubstr("equal_pair_1: Two cells"));
  EXPECT_THAT(again.err, testing::Not(HasSubstr("equal_pair_1: Two cells"))) << "nothing is run again";
  EXPECT_TRUE(std::filesystem::exists(folder / "short/equal_pair_2"));
  EXPECT_FALSE(std::filesystem::exists(folder / "short/equal_pair_3"));
  EXPECT_FALSE(std::filesystem::exists(folder / "short/packing_random_1"));
  EXPECT_THAT(read_text(folder / "short/small.jkr.yaml"),
              testing::AllOf(HasSubstr("young:"), HasSubstr("no time for packing_fcc, packing_bcc")));
}

/// The study may name the file before there is one, and after its cells have become others; then the study runs with it.
TEST(Calibrate, MakesTheFileThatTheStudyNames) {
  const TestFolder folder;
  const auto study = [&](const char* tension) {
    std::ofstream(folder / "study.yaml")
        << "schema: 1\nstudy: small\ntime: {end: 1 min}\ndomain: {size: [80 um, 80 um, 80 um], boundary: open}\n"
           "cell_types: {small: {radius: 5 um, cbm: {law: fitted, file: calibrations/small/small.jkr.yaml}, dcm: {nodes: 42, cortex: "
           "{tension: "
        << tension << "}}}}\ninitial: [{type: small, at: [[0 um, 0 um, 0 um]]}]\n";
  };
  const auto calibrate = [&] {
    return run_morula({"calibrate", "jkr", "small", "study.yaml", "--budget", "3 s"}, folder.path(), {.timeout = kLong});
  };
  study("0.2 mN/m");
  EXPECT_EQ(run_morula({"check", "study.yaml"}, folder.path()).exit_code, 3);
  const Outcome first = calibrate();
  ASSERT_EQ(first.exit_code, 0) << first.all();
  EXPECT_EQ(run_morula({"check", "study.yaml"}, folder.path()).exit_code, 0);
  study("0.3 mN/m");
  EXPECT_THAT(run_morula({"check", "study.yaml"}, folder.path()).err, HasSubstr("E532"));
  const Outcome second = calibrate();
  ASSERT_EQ(second.exit_code, 0) << second.all();
  EXPECT_NE(second.out, first.out);
  EXPECT_EQ(run_morula({"run", "study.yaml"}, folder.path()).exit_code, 0);
}

TEST(Calibrate, RefusesATypeThatTheStudyHasNot) {
  const TestFolder folder;
  folder.write("study.yaml", calibrated_study());
  const Outcome outcome = run_morula({"calibrate", "jkr", "smal", "study.yaml"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 2) << outcome.all();
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("no cell type 'smal'"), HasSubstr("`small`")));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "calibrations"));
  EXPECT_EQ(run_morula({"calibrate", "hertz", "small", "study.yaml"}, folder.path()).exit_code, 2);
}

}  // namespace
}  // namespace morula::test
