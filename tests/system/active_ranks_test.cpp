// The same bits on any number of ranks and over a restart for what acts on marked faces and by itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/system/runs_on_ranks.h"
#include "tests/system/studies.h"

namespace morula::test {

namespace {

namespace fs = std::filesystem;

TEST(ActiveTerms, AreTheSameBitsOnAnyNumberOfRanksAndOverARestart) {
  const TestFolder folder;
  EXPECT_EQ(expect_same_bits_everywhere(folder, active_study(), "45 s")["shells"].get<int>(), 15);
  const Outcome vtk = run_morula({"export", "first", "vtk"}, folder.path());
  ASSERT_EQ(vtk.exit_code, 0) << vtk.all();
  bool found = false;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    if (entry.path().filename() == "shells_000003.vtu") found = read_text(entry.path()).find("Name=\"mark front\"") != std::string::npos;
  EXPECT_TRUE(found) << vtk.all();
}

}  // namespace
}  // namespace morula::test
