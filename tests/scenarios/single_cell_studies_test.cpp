// The single-cell experiments of the library, whole, in their quick version: every criterion holds (physics/scenarios.md S1 to S6, S17). Meshes of their own make
// `torture` slow: here its cells have 162 nodes and a range of contact that fits them; as it is shipped it is run by library.slow.torture.
#include <gtest/gtest.h>

#include <cmath>

#include "core/mesh/remesh.h"
#include "scenarios/criteria/judge.h"
#include "scenarios/library/library.h"
#include "scenarios/measures/holds.h"
#include "scenarios/run/driver.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

class SingleCell : public testing::TestWithParam<const char*> {};

TEST_P(SingleCell, StudyMeetsAllItsCriteriaAndIsPlottedAgainstTheory) {
  if (!has_remesher() && std::string(GetParam()) == "embryo") GTEST_SKIP() << "this build has no remesher (MORULA_WITH_GPL)";
  const test::Folder folder;
  for (const TemplateFile& file : find_template(GetParam())->files) folder.write(std::string(file.path), std::string(file.content));
  ReadOptions options;
  options.overrides = {"output.report=false"};
  if (std::string(GetParam()) == "torture")
    options.overrides.insert(options.overrides.end(), {"cell_types.pressed.dcm.nodes=162", "contact.range=0.5 um"});
  const auto study = read_study(folder.path() / "study.yaml", options);
  ASSERT_TRUE(study.ok()) << study.error().text();
  RunRequest request;
  request.runs = folder.path() / "runs";
  const auto run = scenarios::run(*study, request, Comm());
  ASSERT_TRUE(run.ok()) << run.error().message;
  EXPECT_GE(run->verdicts.size(), 6u);
  for (const Verdict& v : run->verdicts) EXPECT_TRUE(v.passed) << v.id << ": " << v.quantity << " is " << v.value << ", wanted " << v.limit;
  const auto plots = declared_plots(*study, run->path);
  ASSERT_TRUE(plots.ok()) << plots.error().message;
  ASSERT_FALSE(plots->empty());
  for (const NamedPlot& plot : *plots)
    for (const Curve& curve : plot.plot.curves) {
      EXPECT_FALSE(curve.x.empty()) << plot.name << ": " << curve.name;
      for (const double y : curve.y) EXPECT_TRUE(std::isfinite(y)) << plot.name << ": " << curve.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Quick, SingleCell,
                         testing::Values("cell_shear", "doublet", "embryo", "micropipette", "optical_stretcher", "optical_tweezers",
                                         "parallel_plates", "pull_off", "spreading", "torture"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST(Holds, AreTheConstantPartsOfACourseWithTheirLastOutput) {
  std::vector<double> times;
  for (int i = 0; i < 8; ++i) times.push_back(10.0 * i);
  const auto holds = holds_of({{0.0, 20.0, 21.0, 45.0, 46.0}, {0.0, 0.0, 0.5, 0.5, 2.0}}, times);
  ASSERT_EQ(holds.size(), 3u);
  EXPECT_EQ(holds[0].output, 2u);
  EXPECT_EQ(holds[1].output, 4u);
  EXPECT_EQ(holds[1].value, 0.5);
  EXPECT_EQ(holds[2].output, 7u);
  EXPECT_EQ(holds[2].value, 2.0);
  EXPECT_EQ(holds_of({}, times).size(), 1u);
  // A course that ends with a hold rests there until the run ends: one hold, not two.
  const auto last = holds_of({{0.0, 10.0, 50.0}, {0.0, 1.0, 1.0}}, times);
  ASSERT_EQ(last.size(), 1u);
  EXPECT_EQ(last[0].output, 7u);
  // The same value before and after a way is two holds.
  EXPECT_EQ(holds_of({{0.0, 20.0, 30.0, 40.0, 50.0}, {1.0, 1.0, 2.0, 1.0, 1.0}}, times).size(), 2u);
}

}  // namespace
}  // namespace morula::scenarios
