/// Cells that become shells for their age, or because they lie at the border of the tissue: studies with default parameters.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenarios/simulation_of.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

std::string study_of(int count, const std::string& trigger) {
  return "schema: 1\nstudy: triggers\nseed: 1\ntime: {end: 40 min}\ndomain: {size: [200 um, 200 um, 200 um]}\n"
         "cell_types:\n  cell: {radius: 6 um, cycle: {model: none}, dcm: {nodes: 42}}\n"
         "initial:\n  - {type: cell, count: " +
         std::to_string(count) + ", fill: sphere, radius: 27 um}\ncoupling: {triggers: [{" + trigger +
         ", hold: 1 min}]}\noutput: {report: false}\n";
}

/// The tissue at some time [s].
std::unique_ptr<Simulation> run_to(const std::string& text, double time) {
  const auto study = test::read(text);
  EXPECT_TRUE(study.ok()) << study.error().text();
  auto made = test::simulation_of(*study);
  EXPECT_TRUE(made.ok());
  while ((*made)->tissue().clock.time < time) EXPECT_TRUE((*made)->step(time).ok());
  return std::move(*made);
}

TEST(TriggerValues, CellsThatAreOldEnoughBecomeShells) {
  const std::string text = study_of(2, "promote: age > 20 min, demote: age < 10 min");
  EXPECT_EQ(run_to(text, 1190.0)->tissue().shells.size(), 0u);
  EXPECT_EQ(run_to(text, 1500.0)->tissue().shells.size(), 2u);  // one in a step
}

TEST(TriggerValues, CellsAtTheBorderOfATissueBecomeShells) {
  const auto simulation = run_to(study_of(60, "promote: contact_share < 0.2, demote: contact_share > 0.9"), 2400.0);
  const Tissue& tissue = simulation->tissue();
  const std::vector<Vec3d> center = simulation->centers();
  Vec3d middle{};
  for (const Vec3d& c : center) middle += c * (1.0 / static_cast<double>(center.size()));
  double of_shells = 0.0, of_spheres = 0.0;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) (body.is_shell ? of_shells : of_spheres) += norm(center[body.row] - middle);
  ASSERT_GT(tissue.shells.size(), 5u);  // one in a step
  ASSERT_GT(tissue.spheres.size(), 3u);
  EXPECT_GT(of_shells / static_cast<double>(tissue.shells.size()), 1.25 * of_spheres / static_cast<double>(tissue.spheres.size()));
}

}  // namespace
}  // namespace morula::scenarios
