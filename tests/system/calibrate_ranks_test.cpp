#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>

#include "tests/system/morula_command.h"
#include "tests/system/studies.h"

namespace morula::test {
namespace {

constexpr std::chrono::seconds kLong(800);

/// Bytes of what one command finds are the same on two ranks, on two threads, and where it was killed in its second experiment and called again with two threads.
TEST(CalibrateOnRanks, WritesTheSameFileOnRanksAndThreadsAndAfterASigkill) {
  const TestFolder folder;
  folder.write("study.yaml", calibrated_study());
  const auto command = [](const char* out, const char* threads = "1") {
    return std::vector<std::string>{"calibrate", "jkr", "small", "study.yaml", "--budget", "5 s", "--threads", threads, "--out", out};
  };
  ASSERT_EQ(run_morula(command("whole"), folder.path(), {.timeout = kLong}).exit_code, 0);
  const std::string whole = read_text(folder / "whole/small.jkr.yaml");
  ASSERT_THAT(whole, testing::HasSubstr("young:"));
  {
    RunningCommand running(command("killed"), folder.path());
    ASSERT_TRUE(running.wait_for(folder / "killed/equal_pair_2/run/results.h5"));
    running.send(SIGKILL);
    const Outcome killed = running.wait();
    EXPECT_EQ(killed.exit_code, 137) << killed.all();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "killed/small.jkr.yaml"));
  const Outcome again = run_morula(command("killed", "2"), folder.path(), {.timeout = kLong});
  ASSERT_EQ(again.exit_code, 0) << again.all();
  EXPECT_EQ(read_text(folder / "killed/small.jkr.yaml"), whole);
  const Outcome ranks = run_morula(command("ranks"), folder.path(), {.ranks = 2, .timeout = kLong});
  ASSERT_EQ(ranks.exit_code, 0) << ranks.all();
  EXPECT_EQ(read_text(folder / "ranks/small.jkr.yaml"), whole);
}

}  // namespace
}  // namespace morula::test
