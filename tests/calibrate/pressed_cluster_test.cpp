#include "scenarios/calibrate/pressed_cluster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace morula::calibrate {
namespace {

/// Clusters that resist with a yield and with the root of the friction; each with a part of its own.
std::vector<PressedCluster> pressed(double factor, std::initializer_list<double> own = {1.0, 1.2, 0.9}) {
  std::vector<PressedCluster> out;
  for (const double of : own) {
    std::vector<double> part, force;
    for (int k = 0; k <= 60; ++k) {
      part.push_back(k / 60.0);
      force.push_back(5.0 * part.back() * part.back() * (1.0 + 4.0 * std::sqrt(factor * of)));
    }
    out.push_back(pressed_cluster(part, force, 10.0));
  }
  return out;
}
/// Clusters with each factor.
template <class Pressed>
ClustersOfSpheres each(Pressed clusters) {
  return [clusters](std::span<const double> factors) -> Result<std::vector<std::vector<PressedCluster>>> {
    std::vector<std::vector<PressedCluster>> out;
    for (const double factor : factors) out.push_back(clusters(factor));
    return out;
  };
}
ClustersOfSpheres of_spheres() {
  return each([](double factor) { return pressed(factor); });
}

TEST(PressedCluster, HasTheWorkOfBothPlates) {
  const PressedCluster one = pressed_cluster({0.0, 0.5, 1.0}, {0.0, 2.0, 2.0}, 10.0);
  EXPECT_THAT(one.work, testing::ElementsAre(0.0, 10.0, 30.0));  // ∫F dz of one plate: 0.5·2·5, then 2·5
}

TEST(FrictionAlong, ComesBackFromClustersOfAKnownOne) {
  for (const double truth : {0.02, 0.11, 0.5}) {
    const auto found = fit_friction_along(pressed(truth), 50.0, 0.1, of_spheres());
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_NEAR(found->factor / truth, 1.0, 0.06);
    EXPECT_NEAR(found->friction, 50.0 * found->factor, 1e-9);
    EXPECT_LT(found->misfit, 0.02);
    EXPECT_LE(found->low, found->friction);
    EXPECT_GE(found->high, found->friction);
    EXPECT_LT(found->high / found->low, 1.3) << "the clusters agree";
    ASSERT_EQ(found->part.size(), found->shells.size());
    EXPECT_DOUBLE_EQ(found->part.back(), 1.0);
    EXPECT_DOUBLE_EQ(found->shells.back(), 1.0);
    EXPECT_NEAR(found->fitted.back(), 1.0, 0.02);
    EXPECT_GT(found->unfitted.back(), 1.1);
  }
}

TEST(FrictionAlong, HasAWideIntervalWhereClustersDisagree) {
  const auto agree = fit_friction_along(pressed(0.1, {1.0, 1.3, 0.8}), 50.0, 0.1, of_spheres());
  const auto disagree = fit_friction_along(pressed(0.1, {1.0, 3.0, 0.3}), 50.0, 0.1, of_spheres());
  ASSERT_TRUE(agree.ok());
  ASSERT_TRUE(disagree.ok());
  EXPECT_GT(disagree->high / disagree->low, 3.0 * agree->high / agree->low);
}

TEST(FrictionAlong, LeansOnThatOfApproachByWhatClustersLeaveOpen) {
  const auto found = [](double approach, std::initializer_list<double> own) {
    const auto fit = fit_friction_along(pressed(0.1, own), 50.0, approach, of_spheres());
    return fit.ok() ? std::log2(fit->factor) : 99.0;
  };
  EXPECT_NEAR(found(0.4, {1.0, 1.2, 0.9}) - found(0.025, {1.0, 1.2, 0.9}), 0.0, 0.1);
  const double open = found(0.4, {1.0, 6.0, 0.1}) - found(0.025, {1.0, 6.0, 0.1});
  EXPECT_GT(open, 0.5);
  EXPECT_LT(open, 4.0) << "what they say counts";
}

TEST(FrictionAlong, OfOneClusterIsThatOfApproach) {
  const auto of_one = each([](double factor) { return pressed(factor, {1.0}); });
  const auto found = fit_friction_along(pressed(0.1, {1.0}), 50.0, 0.0625, of_one);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_DOUBLE_EQ(found->factor, 0.0625);
  const double reach = std::pow(4.0, 1.96);  // 95 % of what it may differ from approach
  EXPECT_NEAR(found->high / found->friction, reach, 0.02 * reach);
  EXPECT_NEAR(found->friction / found->low, reach, 0.02 * reach);
}

TEST(FrictionAlong, OfSpheresThatAlwaysResistMoreIsLessThanThatOfApproach) {
  const auto too_stiff = each([](double factor) { return pressed(factor + 0.5); });
  const auto found = fit_friction_along(pressed(0.01), 50.0, 0.1, too_stiff);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_LT(found->factor, 0.1);
  EXPECT_GT(found->misfit, 0.1) << "which tells that it is not the friction";
}

TEST(FrictionAlong, HasAnOpenIntervalWhereAnEndIsNotReached) {
  const auto most = fit_friction_along(pressed(4.0), 50.0, 1.0, of_spheres());
  ASSERT_TRUE(most.ok()) << most.error().message;
  EXPECT_TRUE(std::isinf(most->high));
  EXPECT_NEAR(most->factor, 4.0, 0.2);
  const auto least = fit_friction_along(pressed(1.0 / 1024.0), 50.0, 0.01, of_spheres());
  ASSERT_TRUE(least.ok()) << least.error().message;
  EXPECT_EQ(least->low, 0.0);
}

TEST(FrictionAlong, TellsWhatCannotBe) {
  EXPECT_FALSE(fit_friction_along({}, 50.0, 0.1, of_spheres()).ok());
  EXPECT_THAT(fit_friction_along(pressed(0.1), 0.0, 0.1, of_spheres()).error().message, testing::HasSubstr("without friction"));
  const PressedCluster loose = pressed_cluster({0.0, 1.0}, {0.0, 0.0}, 10.0);
  EXPECT_THAT(fit_friction_along({loose}, 50.0, 0.1, of_spheres()).error().message, testing::HasSubstr("did not resist"));
  const auto fails = [](std::span<const double>) -> Result<std::vector<std::vector<PressedCluster>>> {
    return Error{ErrorKind::kPhysics, "spheres fly apart", ""};
  };
  EXPECT_EQ(fit_friction_along(pressed(0.1), 50.0, 0.1, fails).error().message, "spheres fly apart");
}

}  // namespace
}  // namespace morula::calibrate
