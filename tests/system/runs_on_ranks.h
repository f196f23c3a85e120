#pragma once
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

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

/// Runs a study (into `first`), and expects the same state, series and events of it on four ranks, and stopped at `until` on two ranks and gone on with on two
/// threads, and the other way round. (The program on one rank of mpirun: repeat_ranks_test.cpp.) Gives what `info` says of the first.
inline nlohmann::json expect_same_bits_everywhere(const TestFolder& folder, const std::string& study, const std::string& until) {
  folder.write("study.yaml", study);
  const auto outcome_of = [&](std::vector<std::string> command, int ranks) {
    if (ranks == 0) command.insert(command.end(), {"--threads", "2"});
    return run_morula(command, folder.path(), on_ranks(ranks, std::chrono::seconds(500)));
  };
  const Outcome first = run_morula({"run", "study.yaml", "--out", "first"}, folder.path(), on_ranks(0, std::chrono::seconds(500)));
  EXPECT_EQ(first.exit_code, 0) << first.all();
  nlohmann::json reference = info_of(folder / "first");
  const auto expect_same = [&](const std::string& run, const Outcome& outcome) {
    ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
    EXPECT_EQ(info_of(folder / run)["state_hash"], reference["state_hash"]) << run;
    for (const char* file : {"events.jsonl", "series.csv"})
      EXPECT_EQ(read_text(folder / run / file), read_text(folder / "first" / file)) << run << ' ' << file;
  };
  expect_same("ranks4", outcome_of({"run", "study.yaml", "--out", "ranks4"}, 4));
  for (const auto& [before, after] : {std::pair{2, 0}, std::pair{0, 2}}) {
    const std::string name = "from" + std::to_string(before);
    const Outcome half = outcome_of({"run", "study.yaml", "--out", name, "--until", until}, before);
    EXPECT_EQ(half.exit_code, 0) << half.all();
    expect_same(name, outcome_of({"resume", name}, after));
  }
  return reference;
}

}  // namespace morula::test
