#pragma once
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/system/morula_command.h"

namespace morula::test {

/// What `morula info RUN --json` prints.
inline nlohmann::json info_of(const std::filesystem::path& run) {
  const Outcome outcome = run_morula({"info", run.string(), "--json"}, run.parent_path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
  return nlohmann::json::parse(outcome.out, nullptr, false);
}

/// 0: without mpirun.
inline CommandOptions on_ranks(int ranks, std::chrono::seconds timeout = std::chrono::seconds(120)) {
  CommandOptions options;
  options.ranks = ranks;
  options.timeout = timeout;
  return options;
}

}  // namespace morula::test
