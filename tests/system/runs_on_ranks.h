#pragma once
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "tests/system/morula_command.h"
#include "tests/system/run_info.h"
#include "tests/system/studies.h"

namespace morula::test {

/// 0: without mpirun.
inline CommandOptions on_ranks(int ranks, std::chrono::seconds timeout = std::chrono::seconds(120)) {
  CommandOptions options;
  options.ranks = ranks;
  options.timeout = timeout;
  return options;
}

/// Runs a study (into `first`), and expects the same state and series of it on two threads, on 1, 2 and 4 ranks, and stopped at `until` on two ranks and
/// gone on with on one, and the other way round. Gives what `info` says of the first.
inline nlohmann::json expect_same_bits_everywhere(const TestFolder& folder, const std::string& study, const std::string& until) {
  folder.write("study.yaml", study);
  const auto given_time = [](int ranks) { return on_ranks(ranks, std::chrono::seconds(500)); };
  const Outcome first = run_morula({"run", "study.yaml", "--out", "first"}, folder.path(), given_time(0));
  EXPECT_EQ(first.exit_code, 0) << first.all();
  nlohmann::json reference = info_of(folder / "first");
  const auto expect_same = [&](const std::string& run, const Outcome& outcome) {
    ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
    EXPECT_EQ(info_of(folder / run)["state_hash"], reference["state_hash"]) << run;
    EXPECT_EQ(read_text(folder / run / "series.csv"), read_text(folder / "first/series.csv")) << run;
  };
  expect_same("threads", run_morula({"run", "study.yaml", "--out", "threads", "--threads", "2"}, folder.path(), given_time(0)));
  for (const int ranks : {1, 2, 4}) {
    const std::string name = "ranks" + std::to_string(ranks);
    expect_same(name, run_morula({"run", "study.yaml", "--out", name}, folder.path(), given_time(ranks)));
  }
  for (const auto& [before, after] : {std::pair{2, 0}, std::pair{0, 2}}) {
    const std::string name = "from" + std::to_string(before);
    const Outcome half = run_morula({"run", "study.yaml", "--out", name, "--until", until}, folder.path(), given_time(before));
    EXPECT_EQ(half.exit_code, 0) << half.all();
    expect_same(name, run_morula({"resume", name}, folder.path(), given_time(after)));
  }
  return reference;
}

}  // namespace morula::test
