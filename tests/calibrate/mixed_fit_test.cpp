#include "scenarios/calibrate/mixed_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace morula::calibrate {
namespace {

using testing::HasSubstr;

/// A body on a Winkler foundation that adheres: π k R δ² − 2π W R, in the units of both factors, over depths 0 to 1.
double force(double stiffness, double adhesion, double depth) { return 6.0 * stiffness * depth * depth - 4.0 * adhesion; }

MixedData data_for(double stiffness, double adhesion, double noise, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> draw(0.0, noise > 0.0 ? noise : 1.0);
  const auto with_noise = [&](double value) { return noise > 0.0 ? value + draw(engine) : value; };
  constexpr int kPlaces = 64;
  const auto depth = [](int p) { return (p + 0.5) / kPlaces; };
  MixedData out{.wanted = {}, .trials = {}, .scale = 4.0};
  for (int p = 0; p < kPlaces; ++p) out.wanted.push_back(with_noise(force(stiffness, adhesion, depth(p))));
  for (const double k : {0.25, 0.5, 1.0, 2.0})
    for (const double w : {0.7, 0.85, 1.0, 1.15}) {
      MixedTrial& trial = out.trials.emplace_back(MixedTrial{k, w, {}});
      for (int p = 0; p < kPlaces; ++p) trial.force.push_back(with_noise(force(k, w, depth(p))));
    }
  return out;
}

/// A parabola is off an exponential eˣ over x = −2h to 0 by e⁻ʰh³/24 at least (Chebyshev), here by 0.033 from 0.25 to 2, and one of least squares by up to
/// twice that: this is how near the factors come without noise.
TEST(MixedFit, FindsBothFactors) {
  for (const auto& [k, w] : {std::pair{0.5, 0.85}, {0.7, 0.9}, {1.4, 1.05}}) {
    const auto fit = fit_mixed(data_for(k, w, 0.0, 1));
    ASSERT_TRUE(fit.ok()) << fit.error().message;
    EXPECT_NEAR(fit->stiffness, k, 0.066) << k;
    EXPECT_NEAR(fit->adhesion / w, 1.0, 0.02) << w;
    EXPECT_FALSE(fit->at_border);
  }
}

/// Places that do not tell the stiffness, for all cells there hardly touch, and a way that does: k = 1.3 is where nobody moves, and the interval is that of the places along the
/// line on which the way is 0.
TEST(MixedFit, FindsWhereNobodyMovesWhenACellBecomesAShell) {
  MixedData data = data_for(0.5, 0.9, 0.0, 1);
  for (double& wanted : data.wanted) wanted = force(0.0, 0.9, 0.0);
  for (MixedTrial& trial : data.trials) {
    for (double& f : trial.force) f = force(0.0, trial.adhesion, 0.0);
    trial.way = 0.04 * std::log(trial.stiffness / 1.3);
  }
  data.way_scale = 0.005;
  const auto fit = fit_mixed(data);
  ASSERT_TRUE(fit.ok()) << fit.error().message;
  EXPECT_NEAR(fit->stiffness, 1.3, 1e-3);
  EXPECT_NEAR(fit->adhesion, 0.9, 0.005);
  EXPECT_LT(fit->stiffness_interval.high, 1.4);
  data.way_scale = 0.0;
  EXPECT_GT(std::abs(fit_mixed(data)->stiffness - 1.3), 0.1) << "only the way tells";
}

/// With noise of 8 % of the scale at every place of every curve, as contact lines make that jump from node to node: 95 % of the intervals should cover the truth.
/// Of 100 draws 89 to 99 do so with a probability above 0.99 (binomial), and the polynomial's own error is small against the noise.
TEST(MixedFit, TellsHowSureItIs) {
  int covered[2] = {0, 0};
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto fit = fit_mixed(data_for(0.7, 0.9, 0.32, seed));
    ASSERT_TRUE(fit.ok());
    covered[0] += fit->stiffness_interval.low <= 0.7 && 0.7 <= fit->stiffness_interval.high ? 1 : 0;
    covered[1] += fit->adhesion_interval.low <= 0.9 && 0.9 <= fit->adhesion_interval.high ? 1 : 0;
  }
  for (const int count : covered) {
    EXPECT_GE(count, 88);
    EXPECT_LE(count, 100);
  }
}

TEST(MixedFit, StaysWithinWhatWasTried) {
  const auto fit = fit_mixed(data_for(5.0, 0.9, 0.0, 1));
  ASSERT_TRUE(fit.ok());
  EXPECT_NEAR(fit->stiffness, 2.0, 1e-3);
  EXPECT_TRUE(fit->at_border);
}

/// Cells that do not adhere have one factor.
TEST(MixedFit, LeavesAFactorThatAllTrialsShare) {
  MixedData data = data_for(0.7, 1.0, 0.0, 1);
  std::erase_if(data.trials, [](const MixedTrial& trial) { return trial.adhesion != 1.0; });
  const auto fit = fit_mixed(data);
  ASSERT_TRUE(fit.ok()) << fit.error().message;
  EXPECT_NEAR(fit->stiffness, 0.7, 0.04);
  EXPECT_DOUBLE_EQ(fit->adhesion, 1.0);
  EXPECT_FALSE(fit->at_border);
}

TEST(MixedFit, RefusesTooLittle) {
  MixedData data = data_for(0.7, 0.9, 0.0, 1);
  data.trials.resize(5);
  EXPECT_THAT(fit_mixed(data).error().message, HasSubstr("too few"));
  data.trials.front().force.pop_back();
  EXPECT_THAT(fit_mixed(data).error().message, HasSubstr("other places"));
  data.wanted.resize(7);
  EXPECT_THAT(fit_mixed(data).error().message, HasSubstr("7 places"));
  data.trials.clear();
  EXPECT_THAT(fit_mixed(data).error().message, HasSubstr("no trial"));
}

}  // namespace
}  // namespace morula::calibrate
