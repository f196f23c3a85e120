// The same bits on any number of threads and ranks, over kills and restarts, for a tissue of both kinds of body.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "tests/system/morula_command.h"
#include "tests/system/runs_on_ranks.h"
#include "tests/system/studies.h"

namespace morula::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The hash of the hybrid study after one rank and one thread ran it without a break.
class Repeat : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new TestFolder;
    folder->write("study.yaml", hybrid_study());
    first = run_morula({"run", "study.yaml", "--out", "first"}, folder->path(), on_ranks(0));
  }
  static void TearDownTestSuite() { delete folder; }
  void SetUp() override {
    ASSERT_EQ(first.exit_code, 0) << first.all();
    reference = info_of(*folder / "first");
    ASSERT_GT(reference["shells"].get<int>(), 0) << "the study must have shells";
    ASSERT_GT(reference["spheres"].get<int>(), 0) << "and spheres";
    ASSERT_GT(reference["cells"].get<int>(), 30) << "and divisions";
  }
  void expect_same(const std::string& run, const Outcome& outcome) {
    ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
    const json info = info_of(*folder / run);
    EXPECT_EQ(info["state_hash"], reference["state_hash"]) << run;
    EXPECT_EQ(info["cells"], reference["cells"]);
    EXPECT_EQ(read_text(*folder / run / "events.jsonl"), read_text(*folder / "first/events.jsonl")) << run;
  }
  static TestFolder* folder;
  static Outcome first;
  json reference;
};
TestFolder* Repeat::folder = nullptr;
Outcome Repeat::first;

// One test, because each test is a process of its own and the reference is run once.
TEST_F(Repeat, SameBitsOnThreadsAndRanksAndOverRestarts) {
  expect_same("threads", run_morula({"run", "study.yaml", "--out", "threads", "--threads", "2"}, folder->path(), on_ranks(0)));
  CommandOptions limited = on_ranks(0);
  limited.environment.emplace_back("OMP_THREAD_LIMIT", "2");
  expect_same("fewer", run_morula({"run", "study.yaml", "--out", "fewer", "--threads", "3"}, folder->path(), limited));
  for (const int ranks : {1, 4}) {
    const std::string name = "ranks" + std::to_string(ranks);
    expect_same(name, run_morula({"run", "study.yaml", "--out", name}, folder->path(), on_ranks(ranks)));
  }
  // half on two ranks, the rest on one; then half on one rank, the rest on two
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "two-one", "--until", "20 min"}, folder->path(), on_ranks(2)).exit_code, 0);
  expect_same("two-one", run_morula({"resume", "two-one"}, folder->path(), on_ranks(0)));
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "one-two", "--until", "20 min"}, folder->path(), on_ranks(0)).exit_code, 0);
  expect_same("one-two", run_morula({"resume", "one-two"}, folder->path(), on_ranks(2)));
}

TEST_F(Repeat, KilledOnTwoRanksAndResumedOnAnotherNumber) {
  const unsigned moment =
      static_cast<unsigned>(std::chrono::steady_clock::now().time_since_epoch().count() % 100);  // before the run is over
  {
    RunningCommand command({"run", "study.yaml", "--out", "killed"}, folder->path(), on_ranks(2));
    ASSERT_TRUE(command.wait_for(*folder / "killed/checkpoints/cp_000001.h5")) << command.wait().all();
    std::this_thread::sleep_for(std::chrono::milliseconds(moment));
    const json status = json::parse(read_text(*folder / "killed/status.json"), nullptr, false);
    ASSERT_TRUE(status.is_object());
    kill(status["process"].get<pid_t>(), SIGKILL);  // a rank dies; mpirun ends the other
    EXPECT_NE(command.wait().exit_code, 0);
  }
  expect_same("killed", run_morula({"resume", "killed"}, folder->path(), on_ranks(0)));
}

TEST_F(Repeat, SigtermToMpirunLeavesACheckpoint) {
  RunningCommand command({"run", "study.yaml", "--out", "stopped", "time.end=40 h"}, folder->path(), on_ranks(2));
  ASSERT_TRUE(command.wait_for(*folder / "stopped/checkpoints/cp_000001.h5")) << command.wait().all();
  command.send(SIGUSR1);  // as a batch system does; mpirun passes it on
  const Outcome outcome = command.wait();
  EXPECT_EQ(outcome.exit_code, 75) << outcome.all();
  EXPECT_FALSE(outcome.timed_out);
  EXPECT_EQ(info_of(*folder / "stopped")["state"], "stopped");
}

/// Loads on chosen nodes are found again on whichever rank a cell is, and after a restart in the middle of a course.
TEST(Loads, GiveTheSameBitsOnRanksAndOverARestart) {
  const TestFolder folder;
  folder.write("study.yaml", loaded_study());
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "one"}, folder.path(), on_ranks(0)).exit_code, 0);
  const json reference = info_of(folder / "one");
  const Outcome outcome = run_morula({"run", "study.yaml", "--out", "ranks"}, folder.path(), on_ranks(3));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_EQ(info_of(folder / "ranks")["state_hash"], reference["state_hash"]);
  EXPECT_EQ(read_text(folder / "ranks/series.csv"), read_text(folder / "one/series.csv"));
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "broken", "--until", "20 s"}, folder.path(), on_ranks(2)).exit_code, 0);
  ASSERT_EQ(run_morula({"resume", "broken"}, folder.path(), on_ranks(0)).exit_code, 0);
  EXPECT_EQ(info_of(folder / "broken")["state_hash"], reference["state_hash"]);
}

/// Nuclei move between ranks with their shells, and a restart finds them where they were.
void expect_same_bits_on_ranks_and_over_a_restart(const std::string& study) {
  const TestFolder folder;
  folder.write("study.yaml", study);
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "one"}, folder.path(), on_ranks(0)).exit_code, 0);
  const json reference = info_of(folder / "one");
  ASSERT_GT(reference["shells"].get<int>(), 0) << "the study must have shells";
  const Outcome outcome = run_morula({"run", "study.yaml", "--out", "ranks"}, folder.path(), on_ranks(2));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_EQ(info_of(folder / "ranks")["state_hash"], reference["state_hash"]);
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "broken", "--until", "5 min"}, folder.path(), on_ranks(2)).exit_code, 0);
  ASSERT_EQ(run_morula({"resume", "broken"}, folder.path(), on_ranks(0)).exit_code, 0);
  EXPECT_EQ(info_of(folder / "broken")["state_hash"], reference["state_hash"]);
}

TEST(Interior, GivesTheSameBitsOnRanksAndOverARestart) { expect_same_bits_on_ranks_and_over_a_restart(interior_study()); }

/// Who leaves the range of the laws of spheres becomes a shell on any rank; what is told of it is the same text.
TEST(OutsideLaw, PromotesTheSameCellsOnThreadsAndRanksAndOverARestart) {
  const TestFolder folder;
  const std::string study =
      "schema: 1\nstudy: range\nseed: 3\ntime: {end: 12 min, output: 2 min, checkpoint: 2 min}\n"
      "domain: {size: [90 um, 90 um, 90 um], boundary: periodic}\n"
      "cell_types: {cell: {radius: {mean: 6 um, spread: 8 %}, cycle: {model: none}, dcm: {nodes: 42}}}\n"
      "initial:\n  - {type: cell, count: 20, fill: box, size: [32 um, 32 um, 25 um]}\ncontact: {range: 1.2 um}\n"
      "coupling: {max_shells: 12, triggers: [{promote: outside_law > 0.85, demote: outside_law < 0.7, hold: 5 min}]}\noutput: "
      "{report: false}\n";
  const json reference = expect_same_bits_everywhere(folder, study, "6 min");
  EXPECT_GT(reference["shells"].get<int>(), 2);
  EXPECT_GT(reference["spheres"].get<int>(), 2);
}

TEST(NuclearShells, GiveTheSameBitsOnRanksAndOverARestart) {
  expect_same_bits_on_ranks_and_over_a_restart(changed(interior_study(), "nucleus: {radius: 2 um}",
                                                       "nucleus: {kind: shell, radius: 2 um, nodes: 42, lamina: {tension: 0.02 mN/m}}"));
}

}  // namespace
}  // namespace morula::test
