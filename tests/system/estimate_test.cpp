// What `check --estimate` says of tissues that no machine here could hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/system/morula_command.h"

namespace morula::test {
namespace {

using testing::HasSubstr;

/// A hundred million cells, with a limit of 2 s of CPU time and of 3 GB of memory: their places and radii alone would be 3.2 GB.
Outcome check_of_many(const std::string& body) {
  const TestFolder folder;
  folder.write("study.yaml",
               "schema: 1\nstudy: many\ntime: {end: 1 h, output: 30 min}\ndomain: {size: [10 mm, 10 mm, 10 mm]}\n"
               "cell_types: {cell: {radius: 5 um}}\ninitial:\n  - {type: cell, count: 100000000, fill: sphere, radius: 4 mm, as: " +
                   body + "}\n");
  CommandOptions options;
#ifdef __SANITIZE_ADDRESS__
  options.shell_before = "ulimit -t 20;";  // the sanitizer reserves terabytes of addresses
#else
  options.shell_before = "ulimit -t 2; ulimit -v 3000000;";
#endif
  return run_morula({"check", "study.yaml", "--estimate"}, folder.path(), options);
}

TEST(Estimate, OfAHundredMillionSpheresIsThereAtOnce) {
  const Outcome outcome = check_of_many("sphere");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_THAT(outcome.out, HasSubstr("cells   100000000 at the start (0 shells)"));
  // 100,000 spheres took 279 MB and 1.38e-5 s a step and cell: 250 GB, and at 60 s a step a day, within the factor of three that is told
  EXPECT_THAT(outcome.out, HasSubstr("memory  about 250"));
  EXPECT_THAT(outcome.out, HasSubstr("GB\n"));
  EXPECT_THAT(outcome.out, testing::ContainsRegex("time    .* h .* on 1 core"));
}

TEST(Estimate, OfAHundredMillionShellsIsThereAtOnce) {
  const Outcome outcome = check_of_many("shell");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_THAT(outcome.out, HasSubstr("nodes   16200000000\n"));
  EXPECT_THAT(outcome.out, HasSubstr("TB\n"));
  EXPECT_THAT(outcome.out, testing::ContainsRegex("time    .* d on 1 core"));
}

}  // namespace
}  // namespace morula::test
