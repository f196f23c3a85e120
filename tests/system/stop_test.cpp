// Runs that are stopped, interrupted or killed, and go on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "tests/system/morula_command.h"
#include "tests/system/run_info.h"
#include "tests/system/studies.h"

namespace morula::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

/// A study that takes some seconds, with checkpoints at every output.
std::string long_study() { return changed(changed(sphere_study(), "end: 2 h", "end: 200 h"), "checkpoint: 30 min", "checkpoint: 10 min"); }

/// Starts a long run, waits until it is well under way, sends the signal.
Outcome signalled(const TestFolder& folder, int signal) {
  folder.write("study.yaml", long_study());
  RunningCommand command({"run", "study.yaml", "--out", "run"}, folder.path());
  EXPECT_TRUE(command.wait_for(folder / "run/checkpoints/cp_000003.h5")) << "the run did not get going";
  command.send(signal);
  return command.wait();
}

void expect_stopped(const TestFolder& folder, const Outcome& outcome, int exit_code) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.all();
  EXPECT_FALSE(outcome.timed_out);
  EXPECT_THAT(outcome.err, HasSubstr("morula resume run"));
  const json info = info_of(folder / "run");
  EXPECT_EQ(info["state"], "stopped");
  EXPECT_EQ(info["exit_code"], exit_code);
  EXPECT_GT(info["time"].get<double>(), 0.0);
  const Outcome resumed = run_morula({"resume", "run", "--max-wall", "1 ms"}, folder.path());
  EXPECT_EQ(resumed.exit_code, 75) << resumed.all();
  EXPECT_GE(info_of(folder / "run")["time"], info["time"]) << "the checkpoint is of the moment of the signal";
}

TEST(Stop, SigtermLeavesACheckpointAndExit75) {
  const TestFolder folder;
  expect_stopped(folder, signalled(folder, SIGTERM), 75);
}

TEST(Stop, Sigusr1LeavesACheckpointAndExit75) {
  const TestFolder folder;
  expect_stopped(folder, signalled(folder, SIGUSR1), 75);
}

TEST(Stop, AGoneTerminalAClosedPipeAndTheLimitOfCpuTimeLeaveACheckpointAndExit75) {
  for (const int signal : {SIGHUP, SIGPIPE, SIGXCPU, SIGXFSZ}) {
    SCOPED_TRACE(signal);
    const TestFolder folder;
    expect_stopped(folder, signalled(folder, signal), 75);
  }
}

TEST(Stop, TheLimitOfCpuTimeOfTheShellLeavesACheckpoint) {
  const TestFolder folder;
  folder.write("study.yaml", changed(long_study(), "end: 200 h", "end: 2000 h"));
  CommandOptions limited;
  limited.shell_before = "ulimit -S -t 2;";
  expect_stopped(folder, run_morula({"run", "study.yaml", "--out", "run"}, folder.path(), limited), 75);
}

TEST(Stop, WhatNobodyReadsIsDroppedAndTheRunStopsWithACheckpoint) {
  // Adhesion beyond the range of the law: a warning stands before everything that the run itself says, and is the first message that finds no reader.
  const std::string study = changed(long_study(), "end: 200 h", "end: 2000 h");
  for (const char* streams : {"exec 2> >(true)", "exec 2> >(head -n 1 > /dev/null)", "exec > >(head -n 1 > /dev/null) 2>&1"}) {
    SCOPED_TRACE(streams);
    const TestFolder folder;
    folder.write("study.yaml", study);
    ASSERT_THAT(run_morula({"check", "study.yaml"}, folder.path()).all(), HasSubstr("warning:"));
    CommandOptions piped;
    piped.shell_before = streams + std::string("; sleep 0.2;");
    const Outcome outcome = run_morula({"run", "study.yaml", "--out", "run"}, folder.path(), piped);
    EXPECT_EQ(outcome.exit_code, 75) << outcome.all();
    ASSERT_TRUE(fs::exists(folder / "run/run.json"));
    EXPECT_EQ(info_of(folder / "run")["state"], "stopped");
    EXPECT_EQ(run_morula({"resume", "run", "--max-wall", "1 ms"}, folder.path()).exit_code, 75);
  }
}

TEST(Stop, ARefusedStudyWhoseMessagesNobodyReadsIsRefused) {
  const TestFolder folder;
  folder.write("study.yaml", changed(sphere_study(), "seed: 7", "sead: 7"));
  CommandOptions piped;
  piped.shell_before = "exec 2> >(true); sleep 0.2;";
  EXPECT_EQ(run_morula({"run", "study.yaml", "--out", "run"}, folder.path(), piped).exit_code, 2);
}

TEST(Stop, ADoneRunWhoseNameNobodyReadsIsDone) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  CommandOptions piped;
  piped.shell_before = "exec > >(true); sleep 0.2;";
  const Outcome outcome = run_morula({"run", "study.yaml", "--out", "run"}, folder.path(), piped);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_EQ(info_of(folder / "run")["state"], "done");
}

TEST(Stop, NohupKeepsARunGoing) {
  const TestFolder folder;
  folder.write("study.yaml", long_study());
  CommandOptions nohup;
  nohup.shell_before = "trap '' HUP;";
  RunningCommand command({"run", "study.yaml", "--out", "run"}, folder.path(), nohup);
  ASSERT_TRUE(command.wait_for(folder / "run/checkpoints/cp_000003.h5"));
  command.send(SIGHUP);
  EXPECT_TRUE(command.wait_for(folder / "run/checkpoints/cp_000020.h5")) << "it goes on";
  command.send(SIGTERM);
  EXPECT_EQ(command.wait().exit_code, 75);
}

TEST(Stop, ControlCLeavesACheckpointAndExit130) {
  const TestFolder folder;
  expect_stopped(folder, signalled(folder, SIGINT), 130);
}

TEST(Stop, ASecondControlCEndsAtOnce) {
  const TestFolder folder;
  folder.write("study.yaml", long_study());
  RunningCommand command({"run", "study.yaml", "--out", "run"}, folder.path());
  ASSERT_TRUE(command.wait_for(folder / "run/checkpoints/cp_000003.h5"));
  command.send(SIGINT);
  command.send(SIGINT);
  const Outcome outcome = command.wait();
  EXPECT_EQ(outcome.exit_code, 130) << outcome.all();
  EXPECT_EQ(run_morula({"resume", "run", "--max-wall", "1 ms"}, folder.path()).exit_code, 75) << "the checkpoints are whole";
}

TEST(Stop, ASecondRunInTheSameFolderIsRefusedWhileTheFirstRuns) {
  const TestFolder folder;
  folder.write("study.yaml", long_study());
  RunningCommand command({"run", "study.yaml", "--out", "run"}, folder.path());
  ASSERT_TRUE(command.wait_for(folder / "run/checkpoints/cp_000001.h5"));
  const Outcome second = run_morula({"resume", "run"}, folder.path());
  EXPECT_EQ(second.exit_code, 2) << second.all();
  EXPECT_EQ(json::parse(run_morula({"status", "run", "--json"}, folder.path()).out)["state"], "running");
  command.send(SIGTERM);
  EXPECT_EQ(command.wait().exit_code, 75);
}

TEST(Kill, BeforeTheFirstCheckpointIsToldAsLost) {
  const TestFolder folder;
  folder.write("study.yaml",
               sphere_study() + "coupling: {regions: [{name: all, shape: everything, as: shell}]}\n");  // they look for their shape first
  RunningCommand command({"run", "study.yaml", "--out", "killed"}, folder.path());
  ASSERT_TRUE(command.wait_for(folder / "killed/status.json"));
  command.send(SIGSTOP);
  const bool has_checkpoint = std::filesystem::exists(folder / "killed/checkpoints/cp_000000.h5");
  command.send(SIGKILL);
  ASSERT_EQ(command.wait().exit_code, 137);
  ASSERT_FALSE(has_checkpoint);
  EXPECT_EQ(json::parse(run_morula({"status", "killed", "--json"}, folder.path()).out)["state"], "lost");
  EXPECT_THAT(run_morula({"status", "killed"}, folder.path()).out, testing::HasSubstr("begin again: "));
}

/// In a container nobody may ask how a killed process ended: it stays listed, and the run is lost all the same.
TEST(Kill, AProcessThatNobodyHasBuriedIsLost) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  {
    RunningCommand command({"run", "study.yaml", "--out", "run", "time.end=16 h"}, folder.path());
    ASSERT_TRUE(command.wait_for(folder / "run/checkpoints/cp_000001.h5"));
    command.send(SIGKILL);
    (void)command.wait();
  }
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) _exit(0);
  siginfo_t ended;
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT), 0);  // looked at, not taken away
  json status = json::parse(read_text(folder / "run/status.json"));
  status["process"] = child;
  folder.write("run/status.json", status.dump());
  EXPECT_EQ(json::parse(run_morula({"status", "run", "--json"}, folder.path()).out)["state"], "lost");
  waitpid(child, nullptr, 0);
  folder.write("run/status.json", "");  // damaged: what run.json says is told
  EXPECT_EQ(run_morula({"status", "run"}, folder.path()).exit_code, 0);
}

TEST(Kill, AtARandomMomentThenResumeEndsInTheSameBits) {
  const TestFolder folder;
  const std::string study = changed(sphere_study(), "checkpoint: 30 min", "checkpoint: 10 min");
  folder.write("study.yaml", study);
  const std::vector<std::string> longer{"time.end=16 h"};
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "whole", longer[0]}, folder.path()).exit_code, 0);
  const std::string hash = info_of(folder / "whole")["state_hash"];
  const unsigned moment = static_cast<unsigned>(std::chrono::steady_clock::now().time_since_epoch().count() % 400);
  RecordProperty("killed_after_ms", static_cast<int>(moment));
  {
    RunningCommand command({"run", "study.yaml", "--out", "killed", longer[0]}, folder.path());
    ASSERT_TRUE(command.wait_for(folder / "killed/checkpoints/cp_000001.h5"));
    std::this_thread::sleep_for(std::chrono::milliseconds(moment));
    command.send(SIGKILL);
    const Outcome killed = command.wait();
    EXPECT_TRUE(killed.exit_code == 137 || killed.exit_code == 0) << killed.all();
    if (killed.exit_code == 137) {
      EXPECT_EQ(json::parse(run_morula({"status", "killed", "--json"}, folder.path()).out)["state"], "lost");
      EXPECT_EQ(info_of(folder / "killed")["state_hash"].get<std::string>().size(), 32u) << "the newest checkpoint can be hashed";
    }
  }
  const Outcome resumed = run_morula({"resume", "killed"}, folder.path());
  ASSERT_EQ(resumed.exit_code, 0) << "killed after " << moment << " ms\n" << resumed.all();
  EXPECT_EQ(info_of(folder / "killed")["state_hash"], hash) << "killed after " << moment << " ms";
  EXPECT_EQ(read_text(folder / "killed/series.csv").substr(0, 200), read_text(folder / "whole/series.csv").substr(0, 200));
}

}  // namespace
}  // namespace morula::test
