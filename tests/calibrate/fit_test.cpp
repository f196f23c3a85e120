#include "scenarios/calibrate/fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/calibrate/confidence.h"
#include "tests/calibrate/synthetic.h"

namespace morula::calibrate {
namespace {

/// σ = 2 % of the pull-off force for all points, as the reference numbers of fields_and_coupling.md, E have it.
FitOptions of_even_noise() {
  FitOptions out;
  out.poisson = kPoisson;
  out.weights.force_relative = 0.0;
  out.weights.overlap_limit = 1.0;
  return out;
}
/// Scales of the true law, so that the noise is known exactly.
Fit at_the_truth(const Data& data) {
  Fit out;
  out.parameters = {kYoung, kAdhesion, {}};
  out.poisson = kPoisson, out.weights = of_even_noise().weights;
  out.scales = scales_of(data, out.weights);
  out.scales.pull_off = cbm::pull_off_force(reference_pair()) / (0.5 * kRadius);
  return out;
}

TEST(Fit, FindsTheParametersOfPointsWithoutNoise) {
  const auto fitted = fit(jkr_points(-0.5, 1.5, 21, 0.0, 1), {.poisson = kPoisson});
  ASSERT_TRUE(fitted.ok()) << fitted.error().message;
  EXPECT_NEAR(fitted->parameters.young / kYoung, 1.0, 1e-6);
  EXPECT_NEAR(fitted->parameters.adhesion / kAdhesion, 1.0, 1e-6);
  EXPECT_EQ(fitted->starts, 20);
  EXPECT_GE(fitted->agreeing, 15);
}

TEST(Fit, FindsThemFromOneStartAway) {
  const Data data = jkr_points(-0.5, 1.5, 21, 0.0, 1);
  Fit start = at_the_truth(data);
  start.parameters.young = 0.8, start.parameters.adhesion = 0.03;
  const Fit end = fit_again(data, start);
  EXPECT_NEAR(end.parameters.young / kYoung, 1.0, 1e-6);
  EXPECT_NEAR(end.parameters.adhesion / kAdhesion, 1.0, 1e-6);
}

// fields_and_coupling.md, E: 1.37 %, 0.66 %, 0.644; two digits after the point are known.
TEST(Covariance, IsThatOfTheReference) {
  const Data data = jkr_points(-0.5, 1.5, 21, 0.0, 1);
  const Covariance errors = covariance(data, at_the_truth(data));
  EXPECT_NEAR(errors.young_error, 0.0137, 5e-5);
  EXPECT_NEAR(errors.adhesion_error, 0.0066, 5e-5);
  EXPECT_NEAR(errors.correlation, 0.644, 5e-4);
}

TEST(Covariance, OfPairsThatOnlyPressIsThatOfTheReference) {
  const Data data = jkr_points(1.4, 2.0, 21, 0.0, 1);
  const Covariance errors = covariance(data, at_the_truth(data));
  EXPECT_NEAR(errors.young_error, 0.025, 5e-4);
  EXPECT_NEAR(errors.adhesion_error, 0.035, 5e-4);
  EXPECT_NEAR(errors.correlation, 0.987, 5e-4);
}

TEST(Profile, OfALittleNoiseIsTwiceTheStandardError) {
  const Data data = jkr_points(-0.5, 1.5, 21, 1.0, 3);
  const Fit best = fit_again(data, at_the_truth(data));
  const Covariance errors = covariance(data, best);
  const Profile young = profile(data, best, 0);
  EXPECT_TRUE(young.better.empty());
  EXPECT_NEAR(std::log(young.interval.high / young.interval.low), 2 * 1.95996 * errors.young_error, 0.02 * 4 * errors.young_error);
}

// The spread of the reference is that of the standard errors, 1.37 % and 0.66 %; that of 400 repeats scatters by 3.5 % of itself.
TEST(Noise, OfTwoPerCentGivesTheSpreadOfTheReferenceAndIntervalsThatCoverTheTruth) {
  constexpr int kRepeats = 400;
  double sum[2] = {}, square[2] = {};
  int covered[2] = {};
  for (int k = 0; k < kRepeats; ++k) {
    const Data data = jkr_points(-0.5, 1.5, 21, 1.0, static_cast<std::uint32_t>(100 + k));
    Fit start = at_the_truth(data);
    start.parameters.young = 0.8, start.parameters.adhesion = 0.03;
    const Fit best = fit_again(data, start);
    const double ratio[2] = {best.parameters.young / kYoung, best.parameters.adhesion / kAdhesion};
    for (int p = 0; p < 2; ++p) {
      sum[p] += ratio[p], square[p] += ratio[p] * ratio[p];
      const Interval interval = profile(data, best, p).interval;
      const double truth = p == 0 ? kYoung : kAdhesion;
      covered[p] += interval.low <= truth && truth <= interval.high;
    }
    if (k + 1 == 100) {
      for (const double total : sum) EXPECT_NEAR(total / 100, 1.0, 0.01);
    }
  }
  const double expected[2] = {0.0137, 0.0066};
  for (int p = 0; p < 2; ++p) {
    const double mean = sum[p] / kRepeats, spread = std::sqrt((square[p] - kRepeats * mean * mean) / (kRepeats - 1));
    EXPECT_NEAR(mean, 1.0, 3.0 * expected[p] / std::sqrt(kRepeats));
    EXPECT_NEAR(spread, expected[p], 0.1 * expected[p]);
    EXPECT_GE(covered[p], kRepeats * 90 / 100);
    EXPECT_LE(covered[p], kRepeats * 99 / 100);
  }
}

// One force at one overlap is made by a whole curve of E and W, from Hertz's law to bodies as stiff and sticky as one likes.
TEST(Profile, OfDataThatCannotTellIsInfinite) {
  const auto fitted = fit_with_confidence(jkr_points(1.4, 1.4, 4, 0.1, 2), {.poisson = kPoisson}, 20);
  ASSERT_TRUE(fitted.ok()) << fitted.error().message;
  EXPECT_TRUE(std::isinf(fitted->young.interval.high));
  EXPECT_TRUE(std::isinf(fitted->adhesion.interval.high));
  EXPECT_EQ(fitted->adhesion.interval.low, 0.0);
  EXPECT_GT(std::abs(fitted->covariance.correlation), 0.999);
}

TEST(Fit, SaysWhatDataItCannotTake) {
  Data data = jkr_points(-0.5, 1.5, 2, 0.0, 1);
  const auto few = fit(data, {});
  ASSERT_FALSE(few.ok());
  EXPECT_NE(few.error().message.find("three points"), std::string::npos);
  data = jkr_points(-0.5, 1.5, 21, 0.0, 1);
  data.pairs[7].force = std::nan("");
  const auto broken = fit(data, {});
  ASSERT_FALSE(broken.ok());
  EXPECT_NE(broken.error().message.find("pair point 7 of experiment 7"), std::string::npos);
  const auto knots = fit(jkr_points(-0.5, 1.5, 21, 0.0, 1), {.packing = {0.1, 0.3, 0.2}});
  ASSERT_FALSE(knots.ok());
  EXPECT_NE(knots.error().message.find("knot 2"), std::string::npos);
}

}  // namespace
}  // namespace morula::calibrate
