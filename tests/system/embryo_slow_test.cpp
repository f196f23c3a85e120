// The aggregate from a mesh file in its full version: cells as fine as the file, a coarse copy, and its contacts opened and closed again.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/system/morula_command.h"

namespace morula::test {
namespace {

class EmbryoInFull : public testing::Test {
 protected:
  void SetUp() override {
    if (!kCanRemesh) GTEST_SKIP() << "the program has no remesher (MORULA_WITH_GPL)";
    ASSERT_EQ(run_morula({"new", "embryo", "study"}, folder_.path()).exit_code, 0);
    options_.timeout = std::chrono::seconds(1700);
  }
  void run(const std::string& out, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "run");
    arguments.insert(arguments.end(), {"--out", out, "output.report=false"});
    const Outcome outcome = run_morula(arguments, folder_.path(), options_);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  }
  /// Every criterion of a run holds; those with this id are among them.
  void expect_criteria(const std::string& out, const std::string& id) {
    const auto verdict = nlohmann::json::parse(read_text(folder_ / out / "verdict.json"), nullptr, false);
    ASSERT_TRUE(verdict.is_object());
    std::size_t of_id = 0;
    for (const auto& one : verdict["criteria"]) {
      EXPECT_TRUE(one["passed"].get<bool>()) << one;
      of_id += one["id"] == id;
    }
    EXPECT_GE(of_id, 1u) << id;
  }

  TestFolder folder_;
  CommandOptions options_;
};

TEST_F(EmbryoInFull, HoldsItsShapeAndItsContactsAsACoarseCopy) {
  run("full", {"study/full.yaml"});
  expect_criteria("full", "S17.3");
  expect_criteria("full", "S17.6");
}

TEST_F(EmbryoInFull, StaysTheSameWithCellsAsFineAsTheFile) {
  run("fine", {"study/fine.yaml"});
  expect_criteria("fine", "S17.3");
}

TEST_F(EmbryoInFull, OpensItsContactsAndClosesThemAgainFromTheSurfacesOfThatRun) {
  run("open", {"study/decompact.yaml"});
  expect_criteria("open", "S17.4");
  ASSERT_EQ(run_morula({"export", "open", "stl", "--out", "open_stl"}, folder_.path()).exit_code, 0);
  std::filesystem::path last;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "open_stl"))
    if (entry.path().extension() == ".stl" && entry.path() > last) last = entry.path();
  ASSERT_FALSE(last.empty());
  std::filesystem::copy_file(last, folder_ / "study/open.stl");
  run("closed", {"study/decompact.yaml", "cell_types.cell.adhesion.cell=1 mJ/m^2", "initial.0.meshes.file=open.stl",
                 "initial.0.meshes.scale=1 um", "time.end=1 min",
                 "criteria=[{id: S17.1, measure: meshes.closed(cell), between: [16, 16]}, "
                 "{id: S17.5, measure: aggregate.contact_part(cell), against: 0.619, within: 0.05}]"});
  expect_criteria("closed", "S17.5");
}

}  // namespace
}  // namespace morula::test
