#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <sstream>

#include "tests/system/morula_command.h"

namespace morula::test {
namespace {

using testing::HasSubstr;

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream out;
  out << std::ifstream(path).rdbuf();
  return out.str();
}

void write_study(const std::filesystem::path& path) {
  std::ofstream(path) << "schema: 1\nstudy: small\ntime: {end: 1 h}\ndomain: {size: [80 um, 80 um, 80 um], boundary: open}\n"
                         "cell_types: {small: {radius: 5 um, dcm: {nodes: 42}}}\ninitial: [{type: small, at: [[0 um, 0 um, 0 um]]}]\n";
}

/// One command from a study to numbers and a report, for shells with default parameters.
TEST(Calibrate, FindsALawOfShellsAndWritesAReport) {
  const TestFolder folder;
  write_study(folder.path() / "study.yaml");
  const Outcome first =
      run_morula({"calibrate", "jkr", "small", "study.yaml", "--out", "found"}, folder.path(), {.timeout = std::chrono::seconds(800)});
  ASSERT_EQ(first.exit_code, 0) << first.all();
  EXPECT_THAT(first.out, HasSubstr("kPa"));
  const std::string report = text_of(folder.path() / "found" / "report.html");
  EXPECT_THAT(report, testing::AllOf(HasSubstr("force over overlap"), HasSubstr("Held out"), HasSubstr("Profile of E"),
                                     HasSubstr("Two cells that come together by themselves"), HasSubstr("that two plates press flat"),
                                     HasSubstr("A sphere and a shell")));
  EXPECT_THAT(text_of(folder.path() / "found" / "small.jkr.yaml"),
              testing::AllOf(HasSubstr("approach: {factor: "), HasSubstr("along the contact"), HasSubstr("friction_of_shells: {medium: "),
                             HasSubstr("with_shells:"), HasSubstr("held_out: ")));
  const Outcome again =
      run_morula({"calibrate", "jkr", "small", "study.yaml", "--out", "found"}, folder.path(), {.timeout = std::chrono::seconds(800)});
  EXPECT_EQ(again.exit_code, 0) << again.all();
  EXPECT_EQ(again.out, first.out);
  EXPECT_THAT(again.err, testing::Not(HasSubstr("equal_pair_1: Two cells")));  // nothing is run again
}

/// Bytes of what one command finds are the same on two ranks, on two threads, and where it was killed in its second experiment and called again with two threads.
TEST(Calibrate, WritesTheSameFileOnRanksAndThreadsAndAfterASigkill) {
  const TestFolder folder;
  write_study(folder.path() / "study.yaml");
  const auto command = [](const char* out, const char* threads = "1") {
    return std::vector<std::string>{"calibrate", "jkr", "small", "study.yaml", "--pairs-only", "--threads", threads, "--out", out};
  };
  ASSERT_EQ(run_morula(command("whole"), folder.path(), {.timeout = std::chrono::seconds(800)}).exit_code, 0);
  const std::string whole = text_of(folder / "whole/small.jkr.yaml");
  ASSERT_THAT(whole, HasSubstr("young:"));
  {
    RunningCommand running(command("killed"), folder.path());
    ASSERT_TRUE(running.wait_for(folder / "killed/equal_pair_2/run/results.h5"));
    running.send(SIGKILL);
    const Outcome killed = running.wait();
    EXPECT_EQ(killed.exit_code, 137) << killed.all();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "killed/small.jkr.yaml"));
  const Outcome again = run_morula(command("killed", "2"), folder.path(), {.timeout = std::chrono::seconds(800)});
  ASSERT_EQ(again.exit_code, 0) << again.all();
  EXPECT_EQ(text_of(folder / "killed/small.jkr.yaml"), whole);
  const Outcome ranks = run_morula(command("ranks"), folder.path(), {.ranks = 2, .timeout = std::chrono::seconds(800)});
  ASSERT_EQ(ranks.exit_code, 0) << ranks.all();
  EXPECT_EQ(text_of(folder / "ranks/small.jkr.yaml"), whole);
}

TEST(Calibrate, LeavesOutWhatItsBudgetHasNoTimeFor) {
  const TestFolder folder;
  write_study(folder.path() / "study.yaml");
  const auto within = [&](const char* budget) {
    return run_morula({"calibrate", "jkr", "small", "study.yaml", "--budget", budget, "--out", "short"}, folder.path(),
                      {.timeout = std::chrono::seconds(800)});
  };
  const Outcome too_small = within("1 ms");
  EXPECT_EQ(too_small.exit_code, 2) << too_small.all();
  EXPECT_THAT(too_small.err, HasSubstr("is too small for any fit: two cells at two rates alone take about 1 s of one core"));
  const Outcome done = within("0.5 s");
  ASSERT_EQ(done.exit_code, 0) << done.all();
  EXPECT_TRUE(std::filesystem::exists(folder / "short/equal_pair_2"));
  EXPECT_FALSE(std::filesystem::exists(folder / "short/equal_pair_3"));
  EXPECT_FALSE(std::filesystem::exists(folder / "short/packing_random_1"));
  EXPECT_THAT(text_of(folder / "short/small.jkr.yaml"),
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
    return run_morula({"calibrate", "jkr", "small", "study.yaml", "--pairs-only"}, folder.path(), {.timeout = std::chrono::seconds(800)});
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
  write_study(folder.path() / "study.yaml");
  const Outcome outcome = run_morula({"calibrate", "jkr", "smal", "study.yaml"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 2) << outcome.all();
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("no cell type 'smal'"), HasSubstr("`small`")));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "calibrations"));
  EXPECT_EQ(run_morula({"calibrate", "hertz", "small", "study.yaml"}, folder.path()).exit_code, 2);
}

}  // namespace
}  // namespace morula::test
