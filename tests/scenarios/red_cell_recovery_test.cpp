#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/library/library.h"
#include "scenarios/measures/interpolated.h"
#include "scenarios/measures/pulled_cell.h"

namespace morula::scenarios {
namespace {

TEST(Interpolated, IsStraightBetweenPointsAndNothingOutside) {
  EXPECT_DOUBLE_EQ(interpolated({0, 1, 3}, {2, 4, 0}, 0.5), 3.0);
  EXPECT_DOUBLE_EQ(interpolated({0, 1, 3}, {2, 4, 0}, 2.0), 2.0);
  EXPECT_TRUE(std::isnan(interpolated({0, 1, 3}, {2, 4, 0}, 3.1)));
  EXPECT_EQ(interpolated({0, 1, 3}, {2, 4, 0}, 3.0 + 1e-15), 0.0);  // rounding is not outside
  EXPECT_TRUE(std::isnan(interpolated({}, {}, 0.0)));
}

/// The law that was fitted to the first measured cell, L/W = Linf (1 + a e)/(1 − a e), e = exp(−t/0.111 s), on a clock three times as slow: the
/// fit finds the three, and the difference stays that of the measured cells from each other.
TEST(RecoveryFit, FindsTheViscosityOfACurveThatIsTheMeasuredOne) {
  std::vector<PulledCell> recovery;
  const double limit = 1.1, a = (2.4 / limit - 1.0) / (2.4 / limit + 1.0);
  for (int i = 0; i <= 200; ++i) {
    const double t = 0.02 * i, e = std::exp(-t / (3.0 * 0.111));
    recovery.push_back({t, limit * (1.0 + a * e) / (1.0 - a * e), 1.0});
  }
  const RecoveryFit fit = fit_recovery(recovery);
  EXPECT_NEAR(fit.scale, 1.0 / 3.0, 0.03);
  EXPECT_LT(fit.largest, 0.15);
  recovery.resize(3);  // too short to be compared
  EXPECT_TRUE(std::isnan(fit_recovery(recovery).largest));
}

}  // namespace
}  // namespace morula::scenarios
