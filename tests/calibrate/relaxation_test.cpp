#include "scenarios/calibrate/relaxation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace morula::calibrate {
namespace {

/// The reference pair of physics/cbm.md §2.
constexpr double kRadius = 5.0, kMedium = 31.41593;
PairModel reference() { return jkr_model(0.45, 0.4, 0.1); }
/// Its overlap at rest [µm].
constexpr double kRest = 1.371402;

/// Shells that are spheres of this friction, by the closed form, with as many outputs as an experiment has.
Relaxation as_spheres(double friction, double contact_friction, double slower = 1.0) {
  Relaxation out{.radius = kRadius, .medium_friction = kMedium, .contact_friction = contact_friction, .time = {0.0}, .overlap = {0.0}};
  std::vector<double> parts;
  for (int i = 1; i < 1000; ++i) parts.push_back(0.001 * i);
  for (const Passage& one : passages_of_spheres(reference(), kRadius, kMedium, friction, parts)) {
    out.time.push_back(slower * one.time);
    out.overlap.push_back(one.part * kRest);
  }
  out.time.push_back(100.0 * out.time.back());
  out.overlap.push_back(kRest);
  return out;
}

TEST(Relaxation, OfSpheresIsThatOfTheReference) {
  // physics/cbm.md §2, pair adhesion relaxation: δ after t seconds, found by another program
  const std::pair<double, double> medium_alone[] = {{1, 0.065720}, {10, 0.562946}, {30, 1.129612}, {100, 1.368858}};
  const std::pair<double, double> with_contact[] = {{10, 0.010889},   {100, 0.103989},  {300, 0.283647},
                                                    {1000, 0.713712}, {3000, 1.197213}, {10000, 1.369359}};
  const auto time_of = [](double overlap, double friction) {
    const auto found = passages_of_spheres(reference(), kRadius, kMedium, friction, {overlap / kRest});
    return found.empty() ? -1.0 : found.front().time;
  };
  for (const auto& [time, overlap] : medium_alone) EXPECT_NEAR(time_of(overlap, 0.0) / time, 1.0, overlap > 1.3 ? 0.02 : 2e-3) << time;
  for (const auto& [time, overlap] : with_contact) EXPECT_NEAR(time_of(overlap, 50.0) / time, 1.0, overlap > 1.3 ? 0.02 : 2e-3) << time;
}

TEST(FittedFriction, OfSpheresIsTheirOwn) {
  const auto found = fit_approach_friction({as_spheres(50.0, 50.0), as_spheres(50.0, 50.0), as_spheres(50.0, 50.0)}, reference());
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_NEAR(found->friction, 50.0, 0.05);
  EXPECT_NEAR(found->factor, 1.0, 1e-3);
  EXPECT_LT(found->misfit, 1e-3);
  EXPECT_LE(found->low, found->friction);
  EXPECT_GE(found->high, found->friction);
  EXPECT_LT(found->high / found->low, 1.01);
}

TEST(FittedFriction, LiesBetweenPairsThatDiffer) {
  const auto found = fit_approach_friction({as_spheres(2.0, 50.0), as_spheres(3.0, 50.0), as_spheres(2.5, 50.0)}, reference());
  ASSERT_TRUE(found.ok());
  EXPECT_GT(found->friction, 2.2);
  EXPECT_LT(found->friction, 2.8);
  EXPECT_NEAR(found->factor, found->friction / 50.0, 1e-12);
  // ln of 2, 2.5 and 3: standard error of their mean 0.117, Student's t of two degrees of freedom 4.303
  EXPECT_NEAR(std::log(found->high / found->friction), 4.303 * 0.1174, 0.02);
  EXPECT_NEAR(std::log(found->friction / found->low), 4.303 * 0.1174, 0.02);
}

TEST(FittedFriction, IsFoundWithoutAMediumToo) {
  Relaxation pair = as_spheres(50.0, 50.0);
  pair.medium_friction = 0.0;
  const auto found = fit_approach_friction({pair}, reference());
  ASSERT_TRUE(found.ok());
  EXPECT_GT(found->friction, 50.0) << "all that held them back is the contact's now";
  EXPECT_LT(found->friction, 55.0);
}

TEST(FittedFriction, IsNoneWhereTheMediumAloneIsTooMuch) {
  const auto found = fit_approach_friction({as_spheres(0.0, 50.0, 0.5)}, reference());
  ASSERT_TRUE(found.ok());
  EXPECT_EQ(found->friction, 0.0);
  EXPECT_GT(found->misfit, 0.5) << "and the misfit says so";
  EXPECT_TRUE(std::isinf(found->high)) << "one pair tells no interval";
}

TEST(FittedFriction, SaysWhatItCannotBeFoundFrom) {
  EXPECT_FALSE(fit_approach_friction({}, reference()).ok());
  EXPECT_THAT(fit_approach_friction({as_spheres(50.0, 0.0)}, reference()).error().message, testing::HasSubstr("without friction"));
  EXPECT_THAT(fit_approach_friction({as_spheres(50.0, 50.0), as_spheres(50.0, 20.0)}, reference()).error().message,
              testing::HasSubstr("different frictions"));
  EXPECT_THAT(fit_approach_friction({as_spheres(50.0, 50.0)}, jkr_model(0.45, 0.4, 0.0)).error().message,
              testing::HasSubstr("do not attract"));
  Relaxation still = as_spheres(50.0, 50.0);
  for (double& overlap : still.overlap) overlap = -0.1;
  EXPECT_THAT(fit_approach_friction({still}, reference()).error().message, testing::HasSubstr("did not come together"));
}

}  // namespace
}  // namespace morula::calibrate
