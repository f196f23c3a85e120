// The single-cell experiments of the library in their full version (642 nodes), and one cell that becomes 128: every criterion holds.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/morula_command.h"

namespace morula::test {
namespace {

struct StudyFile {
  const char* study;
  const char* file;
  friend void PrintTo(const StudyFile& study, std::ostream* out) { *out << study.study << '/' << study.file; }
};

class FullStudy : public testing::TestWithParam<StudyFile> {};

TEST_P(FullStudy, MeetsAllItsCriteria) {
  const TestFolder folder;
  ASSERT_EQ(run_morula({"new", GetParam().study, "study"}, folder.path()).exit_code, 0);
  CommandOptions options;
  options.timeout = std::chrono::seconds(1500);
  const Outcome outcome = run_morula({"run", std::string("study/") + GetParam().file, "--out", "run"}, folder.path(), options);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  const auto verdict = nlohmann::json::parse(read_text(folder / "run/verdict.json"), nullptr, false);
  ASSERT_TRUE(verdict.is_object());
  EXPECT_GE(verdict["criteria"].size(), 5u);
  for (const auto& one : verdict["criteria"]) EXPECT_TRUE(one["passed"].get<bool>()) << one;
}

INSTANTIATE_TEST_SUITE_P(
    Library, FullStudy,
    testing::Values(StudyFile{"cell_shear", "full.yaml"}, StudyFile{"cell_shear", "pairs.yaml"}, StudyFile{"division", "full.yaml"},
                    StudyFile{"doublet", "angles.yaml"}, StudyFile{"doublet", "elastic.yaml"}, StudyFile{"doublet", "full.yaml"},
                    StudyFile{"micropipette", "full.yaml"}, StudyFile{"micropipette", "elastic.yaml"},
                    StudyFile{"optical_stretcher", "full.yaml"}, StudyFile{"optical_stretcher", "recovery.yaml"},
                    StudyFile{"optical_stretcher", "wrinkling.yaml"}, StudyFile{"optical_tweezers", "full.yaml"},
                    StudyFile{"parallel_plates", "full.yaml"}, StudyFile{"pull_off", "full.yaml"}, StudyFile{"pull_off", "mesh.yaml"},
                    StudyFile{"pull_off", "speed.yaml"}, StudyFile{"pull_off", "adhesion.yaml"}, StudyFile{"pull_off", "friction.yaml"},
                    StudyFile{"spreading", "angles.yaml"}, StudyFile{"spreading", "elastic.yaml"}, StudyFile{"spreading", "full.yaml"},
                    StudyFile{"torture", "through.yaml"}, StudyFile{"torture", "suction.yaml"}),
    [](const auto& instance) {
      const std::string file = instance.param.file;
      return std::string(instance.param.study) + "_" + file.substr(0, file.find('.'));
    });

}  // namespace
}  // namespace morula::test
