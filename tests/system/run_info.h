#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/system/morula_command.h"

namespace morula::test {

/// What `morula info --json` says of a run.
inline nlohmann::json info_of(const std::filesystem::path& run) {
  const Outcome outcome = run_morula({"info", run.string(), "--json"}, run.parent_path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
  return nlohmann::json::parse(outcome.out, nullptr, false);
}

}  // namespace morula::test
