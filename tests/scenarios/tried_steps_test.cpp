#include "scenarios/run/tried_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace morula::scenarios {
namespace {

/// Steps from 0 to `end`, each 0.01 s of CPU, whose size is that at time t.
template <class Size>
std::vector<TriedStep> steps_to(double end, const Size& size) {
  std::vector<TriedStep> out;
  for (double t = 0.0; t < end;) {
    t += size(t);
    out.push_back({t, 0.01 * static_cast<double>(out.size() + 1)});
  }
  return out;
}

TEST(TriedSteps, ThatAreAllAlikeGoOnSo) {
  const auto steps = steps_to(100.0, [](double) { return 1.0; });
  EXPECT_NEAR(cost_ahead(steps, 1100.0, 60.0), 10.0, 0.05 * 10.0);
  EXPECT_NEAR(cost_ahead(steps, 1100.0, 0.5), 20.0, 0.05 * 20.0) << "no step is larger than it may be";
}

TEST(TriedSteps, ThatGrowWithTimeCostTheMeanOfThoseThatStayAndThoseThatGrowOn) {
  // Δt = t/200: 139 steps in the last half of the time, where one more or less changes p by 0.01. 200 ln(T/t) steps follow if they go on so, and
  // (T − t)/Δt if they stay.
  const auto steps = steps_to(100.0, [](double t) { return std::max(0.005, t / 200.0); });
  const double t = steps.back().end, grow = 200.0 * std::log(1e4 / t), stay = (1e4 - t) / (t / 200.0);
  EXPECT_NEAR(cost_ahead(steps, 1e4, 1e9) / (0.01 * std::sqrt(grow * stay)), 1.0, 0.05);
  // the same until they are as large as they may be, at 500 s
  const double bounded = 200.0 * std::log(500.0 / t) + (1e4 - 500.0) / 2.5;
  EXPECT_NEAR(cost_ahead(steps, 1e4, 2.5) / (0.01 * std::sqrt(bounded * stay)), 1.0, 0.05);
}

TEST(TriedSteps, ThatReachTheEndOrAreNoneLeaveNothing) {
  EXPECT_EQ(cost_ahead({}, 100.0, 1.0), 0.0);
  EXPECT_EQ(cost_ahead(steps_to(100.0, [](double) { return 1.0; }), 100.0, 1.0), 0.0);
  const TriedStep one{2.0, 0.3};
  EXPECT_NEAR(cost_ahead({&one, 1}, 4.0, 2.0), 0.3, 0.15) << "a single step is followed by its like";
}

}  // namespace
}  // namespace morula::scenarios
