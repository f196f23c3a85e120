#include "coupling/behaviours/growth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "coupling/behaviours/draw.h"
#include "coupling/behaviours/pressure_filter.h"

namespace morula {
namespace {

constexpr double kHour = 3600.0;

CellType cycling(bool exponential) {
  CellType type;
  type.cycles = true;
  type.cycle.growth = growth_laws()[exponential ? 1 : 0];
  return type;
}

CellRow newborn(double volume = 1000.0, double duration = 18 * kHour) {
  CellRow row;
  row.id = CellId::founder(1);
  row.birth_volume = row.target_volume = volume;
  row.division_volume = 2 * volume;
  row.cycle_duration = duration;
  return row;
}

TEST(Growth, FollowsItsLawInUnevenSteps) {
  for (const bool exponential : {false, true}) {
    const CellType type = cycling(exponential);
    CellRow row = newborn();
    double time = 0.0;
    for (int n = 0; time < 12 * kHour - 200; ++n) {
      const double dt = 10.0 + 7.3 * (n % 11);
      EXPECT_FALSE(grow(row, type, dt).reached);
      time += dt;
    }
    EXPECT_FALSE(grow(row, type, 12 * kHour - time).reached);
    // V_b(1 + 12/18) and V_b 2^(12/18).
    EXPECT_NEAR(row.target_volume, exponential ? 1587.4010519682 : 1666.6666666667, 1e-7);
  }
}

/// The smaller of two unequal daughters has more than its own volume to gain: V_b + (V_d − V_b)/2 and √(V_b V_d) after half the cycle.
TEST(Growth, GoesFromAnyVolumeAtBirthToThatOfDivision) {
  for (const bool exponential : {false, true}) {
    const CellType type = cycling(exponential);
    CellRow row = newborn(800.0);
    row.division_volume = 2000.0;
    for (int n = 0; n < 540; ++n) ASSERT_FALSE(grow(row, type, 60.0).reached);
    EXPECT_NEAR(row.target_volume, exponential ? 1264.9110640674 : 1400.0, 1e-7);
    const Growth rest = grow(row, type, 10 * kHour);
    EXPECT_TRUE(rest.reached);
    EXPECT_NEAR(rest.late, kHour, 1e-5);
  }
}

TEST(Growth, ReachesTheDivisionVolumeInTheStepThatEndsAtTheCycle) {
  for (const bool exponential : {false, true}) {
    for (const double dt : {60.0, 30.0, 0.7, 64800.0}) {
      const CellType type = cycling(exponential);
      CellRow row = newborn();
      const auto steps = static_cast<int>(std::ceil(18 * kHour / dt - 1e-9));
      for (int n = 0; n + 1 < steps; ++n) ASSERT_FALSE(grow(row, type, dt).reached) << n;
      const Growth last = grow(row, type, dt);
      EXPECT_TRUE(last.reached) << dt;
      EXPECT_EQ(row.target_volume, row.division_volume);
      EXPECT_NEAR(last.late, steps * dt - 18 * kHour, 1e-3) << dt;
    }
  }
}

TEST(Growth, TellsHowLateInTheStepItWas) {
  for (const bool exponential : {false, true}) {
    CellRow row = newborn();
    const Growth growth = grow(row, cycling(exponential), 20 * kHour);
    EXPECT_TRUE(growth.reached);
    EXPECT_NEAR(growth.late, 2 * kHour, 1e-6);
  }
}

LawValues with_limit(double limit) {
  LawValues out;
  out.set("limit", limit);
  return out;
}

/// From 1 to 2 in one unit of time, with V_∞ = 3: r = ln 4 of the logistic law, whose V/(3 − V) doubles in half of the time, and r = ln 2 of the
/// relaxing one.
TEST(GrowthLaws, HaveTheirVolumeHalfway) {
  const GrowthPace pace{1.0, 2.0, 1.0};
  const std::map<std::string, double> halfway{
      {"linear", 1.5}, {"exponential", std::sqrt(2.0)}, {"logistic", 1.5}, {"relaxing", 3.0 - std::sqrt(2.0)}, {"none", 1.0}};
  for (const auto& law : growth_laws()) {
    ASSERT_TRUE(halfway.contains(law->word));
    EXPECT_NEAR(law->after(pace, with_limit(1.5), 1.0, 0.5), halfway.at(law->word), 1e-14) << law->word;
    EXPECT_NEAR(law->at(pace, with_limit(1.5), 0.5), halfway.at(law->word), 1e-14) << law->word;
  }
}

TEST(GrowthLaws, AreTheSameInAnySteps) {
  const GrowthPace pace{1000.0, 2600.0, 64800.0};
  for (const auto& law : growth_laws()) {
    double volume = pace.from, time = 0.0;
    for (int n = 0; n < 700; ++n) {
      const double dt = 10.0 + 7.3 * (n % 11);
      volume = law->after(pace, with_limit(1.2), volume, dt);
      time += dt;
      ASSERT_NEAR(volume / law->at(pace, with_limit(1.2), time / pace.duration), 1.0, 1e-11) << law->word;
      if (!law->grows) continue;
      ASSERT_NEAR(law->time_to(pace, with_limit(1.2), pace.from, volume), time, 1e-6) << law->word;
      ASSERT_NEAR(law->time_to(pace, with_limit(1.2), volume, pace.to), pace.duration - time, 1e-6) << law->word;
    }
  }
}

TEST(GrowthLaws, NeverComeToTheVolumeAtWhichTheyEnd) {
  const GrowthPace pace{1.0, 2.0, 1.0};
  for (const auto& law : growth_laws()) {
    const double time = law->time_to(pace, with_limit(1.5), 1.5, 3.0);
    EXPECT_EQ(std::isinf(time), law->word == "logistic" || law->word == "relaxing" || law->word == "none") << law->word;
    EXPECT_LE(law->time_to(pace, with_limit(1.5), 2.5, 2.0), 0.0) << law->word;
  }
}

TEST(Growth, StopsAboveTheInhibitingPressureAndGoesOnBelow) {
  CellType type = cycling(false);
  type.inhibit_pressure = 0.2;
  CellRow row = newborn();
  row.pressure = 0.21;
  EXPECT_FALSE(grow(row, type, kHour).reached);
  EXPECT_EQ(row.target_volume, 1000.0);
  row.pressure = 0.2;
  EXPECT_FALSE(grow(row, type, 9 * kHour).reached);
  EXPECT_NEAR(row.target_volume, 1500.0, 1e-9);
}

TEST(Growth, NeedsATypeThatCycles) {
  CellType type = cycling(false);
  type.cycles = false;
  CellRow row = newborn();
  EXPECT_FALSE(grow(row, type, 100 * kHour).reached);
  EXPECT_EQ(row.target_volume, 1000.0);
}

TEST(Growth, BalancedPopulationHasTheKnownMeanVolume) {
  // Mean of the volume over the age density: linear 1/ln 2, exponential 2 ln 2 (physics page). Midpoint rule in the probability.
  for (const bool exponential : {false, true}) {
    double mean = 0.0;
    const int n = 20000;
    for (int k = 0; k < n; ++k) mean += volume_in_cycle(newborn(1.0), cycling(exponential), balanced_growth_age((k + 0.5) / n)) / n;
    EXPECT_NEAR(mean, exponential ? 1.386294 : 1.442695, 1e-6);
  }
}

TEST(Growth, AgesFillTheCycleByTheBalancedDensity) {
  EXPECT_NEAR(balanced_growth_age(1e-15), 0.0, 1e-14);
  EXPECT_NEAR(balanced_growth_age(1.0 - 1e-15), 1.0, 1e-14);
  // Cumulative density 2(1 − 2^(−a)).
  for (const double a : {0.1, 0.5, 0.9}) EXPECT_NEAR(balanced_growth_age(2.0 * (1.0 - std::exp2(-a))), a, 1e-14);
}

TEST(PressureFilter, IsExactForAConstantPressureWhateverTheSteps) {
  double fine = 0.1, coarse = 0.1;
  for (int n = 0; n < 600; ++n) fine = averaged_pressure(fine, 0.5, 0.1);
  coarse = averaged_pressure(coarse, 0.5, 60.0);
  EXPECT_NEAR(coarse, 0.5 - 0.4 * std::exp(-1.0), 1e-15);
  EXPECT_NEAR(fine, coarse, 1e-12);
}

TEST(TruncatedDraw, StaysWithinThreeDeviationsAndHasTheTruncatedMoments) {
  const Distribution distribution{18.0, 0.1};
  const Random random(5, RandomStream::kDivisionDuration);
  double sum = 0.0, squares = 0.0;
  const int n = 100000;
  for (int k = 1; k <= n; ++k) {
    std::uint64_t index = 0;
    const double value = draw_truncated(distribution, random, CellId::founder(k), index);
    ASSERT_LE(std::abs(value - 18.0), 5.4 + 1e-12);
    ASSERT_GE(index, 1u);
    sum += value;
    squares += (value - 18.0) * (value - 18.0);
  }
  // Variance of N(0, 1) truncated at ±3: 1 − 6φ(3)/(2Φ(3) − 1) = 0.9733369. Four standard errors.
  EXPECT_NEAR(sum / n, 18.0, 4 * 1.8 / std::sqrt(n));
  EXPECT_NEAR(squares / n / (1.8 * 1.8), 0.9733369, 4 * std::sqrt(2.0 / n));
}

TEST(TruncatedDraw, IsNeverNegativeAndDrawsNothingWithoutSpread) {
  const Random random(5, RandomStream::kDivisionDuration);
  for (int k = 1; k <= 5000; ++k) {
    std::uint64_t index = 0;
    EXPECT_GT(draw_truncated({1.0, 0.9}, random, CellId::founder(k), index), 0.0);
  }
  std::uint64_t index = 7;
  EXPECT_EQ(draw_truncated({1.5, 0.0}, random, CellId::founder(1), index), 1.5);
  EXPECT_EQ(index, 7u);
}

}  // namespace
}  // namespace morula
