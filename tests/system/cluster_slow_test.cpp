// Clusters under strong adhesion with the default step control: no surface goes deep into another, and steps stay long.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/morula_command.h"

namespace morula::test {
namespace {

struct Cluster {
  const char* name;
  std::vector<std::string> changes;  ///< of the library's study `cluster`, W with them
  double deepest;                    ///< any surface in another, at any step [µm]
  int most_steps;
  friend void PrintTo(const Cluster& cluster, std::ostream* out) { *out << cluster.name; }
};

class StrongAdhesion : public testing::TestWithParam<Cluster> {};

TEST_P(StrongAdhesion, KeepsSurfacesApartInLongSteps) {
  const TestFolder folder;
  ASSERT_EQ(run_morula({"new", "cluster", "study"}, folder.path()).exit_code, 0);
  CommandOptions options;
  options.timeout = std::chrono::seconds(1500);
  std::vector<std::string> arguments{"run",
                                     "study/study.yaml",
                                     "--out",
                                     "run",
                                     "output.report=false",
                                     "cell_types.blastomere.cycle={duration: 18 h, shells: wait}",
                                     "cell_types.blastomere.dcm.cortex.tension=0.5 mN/m",
                                     "limits.overlap=" + std::to_string(GetParam().deepest) + " um"};
  arguments.insert(arguments.end(), GetParam().changes.begin(), GetParam().changes.end());
  const Outcome outcome = run_morula(arguments, folder.path(), options);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();

  const auto verdict = nlohmann::json::parse(read_text(folder / "run/verdict.json"), nullptr, false);
  ASSERT_TRUE(verdict.is_object());
  bool told = false;
  for (const auto& one : verdict["criteria"]) {
    EXPECT_TRUE(one["passed"].get<bool>()) << one;
    told |= one["id"] == "INV.4" && one["value"].get<double>() > 0.0;
  }
  EXPECT_TRUE(told) << "surfaces that never touched tell nothing";
  const auto run = nlohmann::json::parse(read_text(folder / "run/status.json"), nullptr, false);
  EXPECT_LT(run["steps"].get<int>(), GetParam().most_steps);
}

std::vector<std::string> fifty_five(const std::string& adhesion) {
  return {"time.end=18 h", "initial.0.count=55", "initial.0.radius=27.5 um",
          "cell_types.blastomere.adhesion={blastomere: " + adhesion + "}"};
}

// Limits: time_stepping.md §9 and 5 % of the mean edge of newborn cells of 162 nodes (W = 0.5 mJ/m²). §9 left 13 cells of 642 nodes at W/2γ = 0.9
// at steps of milliseconds; 18 h in steps of a minute are 1080.
INSTANTIATE_TEST_SUITE_P(Cluster, StrongAdhesion,
                         testing::Values(Cluster{"FineMeshAtNineTenths",
                                                 {"cell_types.blastomere.dcm.nodes=642", "contact.range=0.25 um", "time.end=30 min",
                                                  "cell_types.blastomere.adhesion={blastomere: 9e-4 J/m^2}"},
                                                 0.3,
                                                 600},
                                         Cluster{"FiftyFiveCellsAtOneHalf", fifty_five("5e-4 J/m^2"), 0.09, 3000},
                                         Cluster{"FiftyFiveCellsAtNineTenths", fifty_five("9e-4 J/m^2"), 0.3, 3000}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace morula::test
