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

/// A thousand million voxels: the field alone would be 310 GB, and steps with it cannot be tried.
TEST(Estimate, OfFieldsThatFitNoMemoryIsThereAndCheckTellsIt) {
  const TestFolder folder;
  folder.write("study.yaml",
               "schema: 1\nstudy: fine\ntime: {end: 1 min, output: 30 s}\ndomain: {size: [1000 um, 1000 um, 1000 um]}\n"
               "cell_types: {cell: {cycle: {model: none}}}\ninitial: [{type: cell, at: [0 um, 0 um, 0 um]}]\n"
               "fields: {o: {diffusion: 500 um^2/s, initial: 0.1 mM, voxel: 1 um, uptake: {cell: 1 amol/s}}}\n");
  CommandOptions options;
#ifndef __SANITIZE_ADDRESS__
  options.shell_before = "ulimit -v 6000000;";
#endif
  const Outcome outcome = run_morula({"check", "study.yaml", "--estimate"}, folder.path(), options);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_THAT(outcome.err, HasSubstr("this study takes about 310 GB from its start, and this machine has"));
  EXPECT_THAT(outcome.err, HasSubstr("[E699]"));
  EXPECT_THAT(outcome.out, HasSubstr("voxels  1000000000\n  memory  about 310 GB\n"));
}

}  // namespace
}  // namespace morula::test
