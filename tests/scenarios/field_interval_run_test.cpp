// Fields that wait while cells move (decision 0061), by the user's road.
#include "results/state_hash.h"
#include "tests/scenarios/own_parts.h"
#include "tests/scenarios/simulation_of.h"

namespace morula::scenarios::test {
namespace {

/// A ball of 600 cells that inflate from half their volume in five minutes, then grow, and take oxygen: its middle falls by a tenth and more.
const std::string kStudy = R"(schema: 1
study: breathing
time: {end: 30 min, output: 5 min, checkpoint: 30 min}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  cell: {radius: 6 um, cycle: {duration: 18 h}}
fields:
  oxygen: {diffusion: 2e-9 m^2/s, initial: 0.1 mM, boundary: {all: 0.1 mM}, uptake: {cell: {rate: 50 amol/s, half_saturation: 0.01 mM}}}
initial: [{type: cell, count: 600, fill: sphere, radius: 55 um, start_volume: 50 %, inflate: 5 min}]
output: {report: false}
)";

class FieldIntervals : public OwnParts {
 protected:
  FieldIntervals() : OwnParts([](Laws&) {}) {}
};

std::string each_step() { return changed("initial: 0.1 mM", "initial: 0.1 mM, interval_tolerance: 0", kStudy); }

TEST_F(FieldIntervals, GiveTheConcentrationsOfIntegrationAfterEveryStep) {
  run_whole(kStudy, "long");
  run_whole(each_step(), "each");
  const auto least = column("long", "min_oxygen"), least_each = column("each", "min_oxygen");
  const auto mean = column("long", "mean_oxygen"), mean_each = column("each", "mean_oxygen");
  ASSERT_EQ(least.size(), 7u);
  EXPECT_LT(least_each.back(), 0.09) << "the cells take too little for a test";
  for (std::size_t row = 1; row < least.size(); ++row) {
    EXPECT_NEAR(least[row], least_each[row], 1e-4) << "row " << row << ": a part of 1e-3 of the largest concentration";
    EXPECT_NEAR(mean[row], mean_each[row], 1e-4) << "row " << row;
  }
  EXPECT_LT(column("long", "balance_oxygen").back(), 1e-12);
}

TEST_F(FieldIntervals, SpanManyStepsWithinTheirTolerance) {
  auto simulation = simulation_of(study(kStudy));
  ASSERT_TRUE(simulation.ok());
  ASSERT_TRUE((*simulation)->first_swaps().ok());
  int steps = 0, integrations = 0;
  const Clock& clock = (*simulation)->tissue().clock;
  while (clock.time < 1800.0) {
    const auto done = (*simulation)->step(1800.0);
    ASSERT_TRUE(done.ok());
    if (clock.time < 600.0) continue;  // inflating, then settling
    ++steps;
    for (const auto& report : done->fields) {
      ++integrations;
      EXPECT_LT(report.change, 7e-3) << "at " << clock.time << " s: the tolerance is 5e-3, and steps are whole";
    }
  }
  EXPECT_DOUBLE_EQ((*simulation)->tissue().fields[0].time, 1800.0) << "all is as of now where the study asks for it";
  EXPECT_LT(2 * integrations, steps);
}

TEST_F(FieldIntervals, GoOnWithTheSameBitsFromTheMiddleOfOne) {
  const Study s = study(kStudy);
  auto whole = simulation_of(s);
  ASSERT_TRUE(whole.ok());
  const auto step_until = [](Simulation& simulation, const auto& enough) {
    while (!enough(simulation.tissue())) {
      const auto done = simulation.step(1200.0);
      ASSERT_TRUE(done.ok()) << done.error().message;
    }
  };
  const auto waits = [](const Tissue& t) { return t.clock.time > 600.0 && t.fields[0].time < t.clock.time; };
  const auto at_end = [](const Tissue& t) { return t.clock.time >= 1200.0; };
  step_until(**whole, waits);
  auto second = Simulation::create(s.model, (*whole)->tissue(), Comm(), 1);
  ASSERT_TRUE(second.ok());
  step_until(**whole, at_end);
  step_until(**second, at_end);
  EXPECT_EQ(state_hash((*second)->tissue(), Comm()), state_hash((*whole)->tissue(), Comm()));
}

}  // namespace
}  // namespace morula::scenarios::test
