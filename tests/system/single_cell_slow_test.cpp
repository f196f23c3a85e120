// The single-cell experiments of the library in their full version (642 nodes): every criterion holds.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/morula_command.h"

namespace morula::test {
namespace {

class FullStudy : public testing::TestWithParam<const char*> {};

TEST_P(FullStudy, MeetsAllItsCriteria) {
  const TestFolder folder;
  ASSERT_EQ(run_morula({"new", GetParam(), "study"}, folder.path()).exit_code, 0);
  CommandOptions options;
  options.timeout = std::chrono::seconds(1500);
  const Outcome outcome = run_morula({"run", "study/full.yaml", "--out", "run"}, folder.path(), options);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  const auto verdict = nlohmann::json::parse(read_text(folder / "run/verdict.json"), nullptr, false);
  ASSERT_TRUE(verdict.is_object());
  EXPECT_GE(verdict["criteria"].size(), 7u);
  for (const auto& one : verdict["criteria"]) EXPECT_TRUE(one["passed"].get<bool>()) << one;
}

INSTANTIATE_TEST_SUITE_P(Library, FullStudy,
                         testing::Values("doublet", "optical_stretcher", "optical_tweezers", "parallel_plates", "spreading"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace morula::test
