// The same bits on any number of ranks and over a restart for what acts on marked faces and by itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/runs_on_ranks.h"
#include "tests/system/studies.h"

namespace morula::test {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

CommandOptions given_time(int ranks) { return on_ranks(ranks, std::chrono::seconds(500)); }

TEST(ActiveTerms, AreTheSameBitsOnAnyNumberOfRanksAndOverARestart) {
  const TestFolder folder;
  folder.write("study.yaml", active_study());
  const Outcome first = run_morula({"run", "study.yaml", "--out", "first"}, folder.path(), given_time(0));
  ASSERT_EQ(first.exit_code, 0) << first.all();
  const json reference = info_of(folder / "first");
  EXPECT_EQ(reference["shells"].get<int>(), 15);
  const auto expect_same = [&](const std::string& run, const Outcome& outcome) {
    ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
    EXPECT_EQ(info_of(folder / run)["state_hash"], reference["state_hash"]) << run;
    EXPECT_EQ(read_text(folder / run / "series.csv"), read_text(folder / "first/series.csv")) << run;
  };
  for (const int ranks : {2, 4}) {
    const std::string name = "ranks" + std::to_string(ranks);
    expect_same(name, run_morula({"run", "study.yaml", "--out", name}, folder.path(), given_time(ranks)));
  }
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "two-one", "--until", "45 s"}, folder.path(), given_time(2)).exit_code, 0);
  expect_same("two-one", run_morula({"resume", "two-one"}, folder.path(), given_time(0)));
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "one-two", "--until", "45 s"}, folder.path(), given_time(0)).exit_code, 0);
  expect_same("one-two", run_morula({"resume", "one-two"}, folder.path(), given_time(2)));

  const Outcome vtk = run_morula({"export", "first", "vtk"}, folder.path(), given_time(0));
  ASSERT_EQ(vtk.exit_code, 0) << vtk.all();
  bool found = false;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    if (entry.path().filename() == "shells_000003.vtu") found = read_text(entry.path()).find("Name=\"mark front\"") != std::string::npos;
  EXPECT_TRUE(found) << vtk.all();
}

}  // namespace
}  // namespace morula::test
