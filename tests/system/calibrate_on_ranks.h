#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <string>
#include <vector>

#include "tests/system/morula_command.h"
#include "tests/system/studies.h"

namespace morula::test {

/// Bytes of what one command finds with this budget are the same on two ranks, and on one that was killed in its second experiment and called again with two
/// threads.
inline void expect_same_file_on_ranks(const std::string& budget) {
  const std::chrono::seconds given_time(800);
  const TestFolder folder;
  folder.write("study.yaml", calibrated_study());
  const auto command = [&](const char* out, const char* threads = "1") {
    return std::vector<std::string>{"calibrate", "jkr", "small", "study.yaml", "--budget", budget, "--threads", threads, "--out", out};
  };
  const Outcome whole = run_morula(command("whole"), folder.path(), {.ranks = 2, .timeout = given_time});
  ASSERT_EQ(whole.exit_code, 0) << whole.all();
  const std::string found = read_text(folder / "whole/small.jkr.yaml");
  ASSERT_THAT(found, testing::HasSubstr("young:"));
  {
    RunningCommand running(command("killed"), folder.path());
    ASSERT_TRUE(running.wait_for(folder / "killed/equal_pair_2/run/results.h5"));
    running.send(SIGKILL);
    const Outcome killed = running.wait();
    EXPECT_EQ(killed.exit_code, 137) << killed.all();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "killed/small.jkr.yaml"));
  const Outcome again = run_morula(command("killed", "2"), folder.path(), {.timeout = given_time});
  ASSERT_EQ(again.exit_code, 0) << again.all();
  EXPECT_EQ(read_text(folder / "killed/small.jkr.yaml"), found);
}

}  // namespace morula::test
