#include "scenarios/library/reference_table.h"
#include "scenarios/measures/interpolated.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/library/pulled_cell.h"

namespace morula::scenarios {
namespace {

TEST(ReferenceTable, ReadsTheColumnsOfALibraryFile) {
  const ReferenceTable table("optical_tweezers", "rbc_stretch.csv");
  ASSERT_EQ(table.rows(), 13u);
  EXPECT_EQ(table.column("force_pN").back(), 192.7);
  EXPECT_EQ(table.column("axial_diameter_um").front(), 7.74);
  EXPECT_TRUE(table.column("nothing").empty());
  EXPECT_EQ(ReferenceTable("optical_tweezers", "nothing.csv").rows(), 0u);
  EXPECT_EQ(ReferenceTable("optical_tweezers", "rbc_stretch_static_reference.csv").rows(), 22u);
}

TEST(ReferenceTable, WordsAreNotNumbers) {
  const ReferenceTable table("spreading", "spreading_static_reference.csv");
  ASSERT_GT(table.rows(), 0u);
  EXPECT_TRUE(std::isnan(table.column("converged")[0]));
}

TEST(Interpolated, IsStraightBetweenPointsAndNothingOutside) {
  EXPECT_DOUBLE_EQ(interpolated({0, 1, 3}, {2, 4, 0}, 0.5), 3.0);
  EXPECT_DOUBLE_EQ(interpolated({0, 1, 3}, {2, 4, 0}, 2.0), 2.0);
  EXPECT_TRUE(std::isnan(interpolated({0, 1, 3}, {2, 4, 0}, 3.1)));
}

/// The law that was fitted to the first measured cell, L/W = Linf (1 + a e)/(1 − a e), e = exp(−t/0.111 s), on a clock three times as slow: the
/// fit finds the three, and the difference stays that of the measured cells from each other.
TEST(RecoveryFit, FindsTheViscosityOfACurveThatIsTheMeasuredOne) {
  std::vector<Pulled> recovery;
  const double limit = 1.1, a = (2.4 / limit - 1.0) / (2.4 / limit + 1.0);
  for (int i = 0; i <= 200; ++i) {
    const double t = 0.02 * i, e = std::exp(-t / (3.0 * 0.111));
    recovery.push_back({t, 0.0, limit * (1.0 + a * e) / (1.0 - a * e), 1.0, 0.0, 0.0});
  }
  const RecoveryFit fit = fit_recovery(recovery);
  EXPECT_NEAR(fit.scale, 1.0 / 3.0, 0.03);
  EXPECT_LT(fit.largest, 0.15);
  recovery.resize(3);  // too short to be compared
  EXPECT_TRUE(std::isnan(fit_recovery(recovery).largest));
}

}  // namespace
}  // namespace morula::scenarios
