#include "scenarios/library/cap_criteria.h"

#include <gtest/gtest.h>

#include <numbers>

namespace morula::scenarios {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// dcm.md §8, for R = 6 µm: 3 degrees and 1.5 % at c = 0.5 µm, 2 degrees and 0.5 % at c = 0.25 µm, both at 642 nodes.
TEST(CapTolerance, IsNarrowerWhereMeshAndRangeAreFine) {
  const CapTolerance study{4.0, 0.05, 0.03};
  const double r0 = 5.99, angle = 60.0 * kDegree;
  const CapTolerance fine = cap_tolerance(study, angle, 642, 0.25, r0), wide = cap_tolerance(study, angle, 642, 0.5, r0);
  EXPECT_EQ(fine.angle, 2.0);
  EXPECT_EQ(fine.height, 0.005);
  EXPECT_EQ(fine.contact_radius, 0.05);
  EXPECT_EQ(wide.angle, 3.0);
  EXPECT_EQ(wide.height, 0.015);
  for (const CapTolerance& same : {cap_tolerance(study, angle, 162, 0.25, r0), cap_tolerance(study, angle, 642, 0.6, r0),
                                   cap_tolerance(study, 120.0 * kDegree, 642, 0.25, r0)}) {
    EXPECT_EQ(same.angle, 4.0);
    EXPECT_EQ(same.height, 0.03);
  }
  EXPECT_EQ(cap_tolerance({1.0, 0.05, 0.001}, angle, 642, 0.25, r0).angle, 1.0);  // never wider than the study's own
}

ReachedAngle reached(double degrees, bool back = false, double range = 0.25, double ratio = 1.0) {
  return {ratio, range, 642, back, degrees * kDegree};
}

TEST(JudgeWays, ComparesBothWaysToAnAngleAndTwoRanges) {
  std::vector<Verdict> out;
  judge_ways({reached(59.6), reached(60.4, true), reached(61.0, false, 0.5), reached(80.0, false, 0.25, 1.6)}, out);
  ASSERT_EQ(out.size(), 2u);
  for (const Verdict& v : out) {
    EXPECT_TRUE(v.passed) << v.quantity;
    EXPECT_NEAR(v.value, v.id == "T8.1" ? 0.8 : 1.4, 1e-9) << v.quantity;
  }
  EXPECT_NE(out[0].id, out[1].id);
}

TEST(JudgeWays, FailsWhereTheWayMatters) {
  std::vector<Verdict> out;
  judge_ways({reached(59.0), reached(60.1, true), reached(61.1, false, 0.5)}, out);
  ASSERT_EQ(out.size(), 2u);
  for (const Verdict& v : out) EXPECT_FALSE(v.passed) << v.quantity;
}

TEST(JudgeWays, SaysNothingOfAnglesThatHaveNoCounterpart) {
  std::vector<Verdict> out;
  judge_ways({reached(59.0), reached(60.1, true, 0.25, 1.6), reached(61.1, false, 0.3)}, out);
  EXPECT_TRUE(out.empty());
}

}  // namespace
}  // namespace morula::scenarios
