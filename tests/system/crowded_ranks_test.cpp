// More ranks and threads than cores: said at the start, and no waiting for one another.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/runs_on_ranks.h"
#include "tests/system/studies.h"

namespace morula::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A command for bash that runs the program (its arguments are "$@") on the first core this process may use.
std::string on_one_core(const std::string& launcher) {
  return "core=$(taskset -cp $$ | sed 's/.*: //; s/[-,].*//'); taskset -c $core " + launcher + " \"$@\"; exit $?;";
}

TEST(CrowdedCores, TwoRanksOnOneCoreDoNotWaitForEachOthersTimeSlices) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "alone"}, folder.path()).exit_code, 0);
  CommandOptions crowded;
  // mpirun is told of two slots, so that it does not know of the one core: with a waiting rank that keeps the core this takes a minute.
  crowded.shell_before = on_one_core(std::string(MPIEXEC_PROGRAM) + " -n 2 --host localhost:2 --bind-to none");
  crowded.timeout = std::chrono::seconds(40);
  const Outcome two = run_morula({"run", "study.yaml", "--out", "two"}, folder.path(), crowded);
  EXPECT_FALSE(two.timed_out);
  ASSERT_EQ(two.exit_code, 0) << two.all();
  EXPECT_THAT(two.err, AllOf(HasSubstr("warn"), HasSubstr("2 threads share 1 core")));
  EXPECT_THAT(read_text(folder / "two/log.txt"), HasSubstr("2 threads share 1 core"));
  EXPECT_EQ(info_of(folder / "two")["state_hash"], info_of(folder / "alone")["state_hash"]);
}

TEST(CrowdedCores, ThreadsAreCountedAndAnUncrowdedRunSaysNothing) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  CommandOptions crowded;
  crowded.shell_before = on_one_core("");
  const Outcome three = run_morula({"run", "study.yaml", "--out", "three", "--threads", "3", "--until", "10 min"}, folder.path(), crowded);
  ASSERT_EQ(three.exit_code, 0) << three.all();
  EXPECT_THAT(three.err, HasSubstr("3 threads share 1 core"));
  const Outcome one = run_morula({"run", "study.yaml", "--out", "one", "--until", "10 min"}, folder.path(), crowded);
  EXPECT_THAT(one.err, Not(HasSubstr("share")));
}

}  // namespace
}  // namespace morula::test
