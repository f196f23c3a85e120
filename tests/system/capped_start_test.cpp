// Cells that begin deep in each other: with a capped start they come apart, or the run says what to do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/system/morula_command.h"
#include "tests/system/run_info.h"
#include "tests/system/studies.h"

namespace morula::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Two default shells, 3 um deep in each other.
std::string deep_cells(const std::string& numerics) {
  const std::string deep = changed(lone_cell_study(), "[[0 um, 0 um, 0 um]]", "[[0 um, 0 um, 0 um], [9 um, 0 um, 0 um]]");
  return changed(deep, "initial:", "numerics: {" + numerics + "}\nlimits: {overlap: 4 um}\ninitial:");
}

TEST(CappedStart, OfItsOwnDepthLetsDeepCellsOutUnfolded) {
  const TestFolder folder;
  folder.write("study.yaml", deep_cells("start_cap: auto"));
  const Outcome outcome = run_morula({"run", "study.yaml", "--out", "run"}, folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  const auto series = read_text(folder / "run/series.csv");
  const auto column_of = [](const std::string& row, std::size_t column) {
    std::size_t at = 0;
    for (; column > 0; --column) at = row.find(',', at) + 1;
    return row.substr(at, row.find_first_of(",\n", at) - at);
  };
  const std::string header = series.substr(0, series.find('\n'));
  const auto overlap =
      static_cast<std::size_t>(std::count(header.begin(), header.begin() + static_cast<long>(header.find(",overlap [um]") + 1), ','));
  EXPECT_GT(std::stod(column_of(series.substr(header.size() + 1), overlap)), 2.9);
  EXPECT_LT(std::stod(column_of(series.substr(series.rfind('\n', series.size() - 2) + 1), overlap)), 0.1);
}

TEST(CappedStart, ThatFoldsSoftMeshesSaysWhatDoesNot) {
  const TestFolder folder;
  folder.write("study.yaml", deep_cells("start_cap: 0.2 um"));
  const Outcome outcome = run_morula({"run", "study.yaml", "--out", "run"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 4) << outcome.all();
  EXPECT_THAT(outcome.err, HasSubstr("start_cap: auto"));
  // The state at which it ended is the last row and the last snapshot, once also where the run goes on from there and ends again.
  const double ended = info_of(folder / "run")["time"];
  ASSERT_GT(ended, 0.0);
  const std::string series = read_text(folder / "run/series.csv");
  EXPECT_EQ(std::stod(series.substr(series.rfind('\n', series.size() - 2) + 1)), ended);
  EXPECT_EQ(run_morula({"resume", "run"}, folder.path()).exit_code, 4);
  EXPECT_EQ(read_text(folder / "run/series.csv"), series);
}

TEST(CappedStart, ThatDoesNotEndInItsTimeStopsTheRun) {
  const TestFolder folder;  // the cells need about a minute
  folder.write("study.yaml", deep_cells("start_cap: auto, start_cap_within: 20 s"));
  const Outcome failed = run_morula({"run", "study.yaml", "--out", "run"}, folder.path());
  ASSERT_EQ(failed.exit_code, 4) << failed.all();
  EXPECT_THAT(failed.err, AllOf(HasSubstr("the capped start has not ended by"), HasSubstr("[E662]"), HasSubstr("start_cap_within")));
  const Outcome again = run_morula({"resume", "run"}, folder.path());
  EXPECT_EQ(again.exit_code, 4) << "it is no better for a second try\n" << again.all();
  EXPECT_THAT(again.all(), HasSubstr("the run had ended with an error, and goes on unchanged: the capped start has not ended"));
  const Outcome longer = run_morula({"resume", "run", "--set", "numerics.start_cap_within=10 min", "--out", "longer"}, folder.path());
  EXPECT_EQ(longer.exit_code, 0) << longer.all();
}

}  // namespace
}  // namespace morula::test
