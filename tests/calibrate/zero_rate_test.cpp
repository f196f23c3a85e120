#include "scenarios/calibrate/zero_rate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace morula::calibrate {
namespace {

/// F = 3 + 20 v + c v² at v = 0.01, 0.005, 0.0025 in that order.
std::vector<RateSample> runs(double bend) {
  std::vector<RateSample> out;
  for (const double v : {0.01, 0.005, 0.0025}) out.push_back({v, 3.0 + 20.0 * v + bend * v * v});
  return out;
}

TEST(ZeroRate, OfAStraightLineIsItsBeginning) {
  const auto at = to_zero_rate(runs(0.0), 3.0);
  ASSERT_TRUE(at.ok());
  EXPECT_NEAR(at->value, 3.0, 1e-12);
  EXPECT_NEAR(at->slope, 20.0, 1e-9);
  EXPECT_LT(at->remainder, 1e-12);
  EXPECT_TRUE(at->straight);
}

// The line through v and 2v misses a parabola by 2cv² at 0: here 2 · 0.0025² c.
TEST(ZeroRate, TellsTheQuadraticPart) {
  const double bend = 6000.0, part = 2.0 * 0.0025 * 0.0025 * bend;
  const auto at = to_zero_rate(runs(bend), 3.0);
  ASSERT_TRUE(at.ok());
  EXPECT_NEAR(at->value, 3.0 - part, 1e-12);
  EXPECT_NEAR(at->remainder, part / 3.0, 1e-12);
  EXPECT_FALSE(at->straight);
  EXPECT_TRUE(to_zero_rate(runs(bend), 6.0)->straight);
}

TEST(ZeroRate, OfTwoRunsIsNeverStraight) {
  std::vector<RateSample> two = runs(0.0);
  two.pop_back();
  const auto at = to_zero_rate(two, 3.0);
  ASSERT_TRUE(at.ok());
  EXPECT_TRUE(std::isinf(at->remainder));
  EXPECT_FALSE(at->straight);
}

TEST(ZeroRate, SaysWhatItCannotTake) {
  EXPECT_FALSE(to_zero_rate(std::vector<RateSample>{{0.01, 1.0}}, 1.0).ok());
  EXPECT_FALSE(to_zero_rate(std::vector<RateSample>{{0.01, 1.0}, {0.01, 2.0}}, 1.0).ok());
  EXPECT_FALSE(to_zero_rate(std::vector<RateSample>{{0.01, 1.0}, {-0.01, 2.0}}, 1.0).ok());
  EXPECT_FALSE(to_zero_rate(std::vector<RateSample>{{0.01, std::nan("")}, {0.02, 2.0}}, 1.0).ok());
  EXPECT_FALSE(to_zero_rate(runs(0.0), 0.0).ok());
}

}  // namespace
}  // namespace morula::calibrate
