#include "scenarios/calibrate/crowded_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace morula::calibrate {
namespace {

constexpr double kRadius = 5.0, kSurface = 4.0 * std::numbers::pi * kRadius * kRadius;

/// Random packings in which a sphere's pairs say 0.5 to 0.9 of its surface, and cells in their place have `cells` of it.
std::vector<PackingPoint> packings(const std::function<double(double)>& cells, bool held_out = false) {
  std::vector<PackingPoint> out;
  for (int i = 40; i >= 0; --i) {
    const double pairs = 0.5 + 0.01 * i;
    PackingPoint point{.arrangement = Arrangement::kRandom,
                       .radius = kRadius,
                       .held_out = held_out,
                       .random = {},
                       .contact_area = kSurface * cells(pairs)};
    point.random.contact_area = kSurface * pairs;
    out.push_back(point);
  }
  return out;
}

// JKR at no load: a³ = 9πWR*²/(2E*), E* = E/(2(1 − ν²)); the area over that of the ball is πa²/(4πR²).
TEST(CrowdedArea, BeginsWithTwoCellsAtRest) {
  const double modulus = 0.8 / 1.68, contact = std::cbrt(4.5 * std::numbers::pi * 0.05 * 6.25 / modulus);
  EXPECT_NEAR(resting_share(jkr_model(0.8, 0.4, 0.05), kRadius), contact * contact / (4.0 * kRadius * kRadius), 1e-9);
  EXPECT_EQ(resting_share(jkr_model(0.8, 0.4, 0.0), kRadius), 0.0) << "nothing holds them together";
}

TEST(CrowdedArea, GivesACurveBack) {
  const auto truth = [](double pairs) { return 0.1 + 1.1 * pairs; };
  auto points = packings(truth);
  const auto others = packings(truth, true);
  points.insert(points.end(), others.begin(), others.end());
  const FittedCrowding found = fit_crowded_area(points, 0.1);
  ASSERT_EQ(found.knots.size(), 9u);
  EXPECT_EQ(found.knots.front().pairs, 0.1);
  EXPECT_EQ(found.knots.front().cells, 0.1);
  for (std::size_t k = 1; k < found.knots.size(); ++k) EXPECT_NEAR(found.knots[k].cells, truth(found.knots[k].pairs), 1e-12);
  EXPECT_EQ(found.packings, 41);
  EXPECT_LT(found.held_out, 0.005) << "beyond the outermost means the ratio stays";
  double sum = 0.0;
  for (int i = 0; i <= 40; ++i) sum += std::pow((0.5 + 0.01 * i) / truth(0.5 + 0.01 * i) - 1.0, 2);
  EXPECT_NEAR(found.pairs_alone, std::sqrt(sum / 41.0), 1e-12);
  EXPECT_EQ(found.points.size(), 82u);
}

// Cells that fill the room are pressed smaller, and so are their contacts.
TEST(CrowdedArea, FollowsAreasThatRiseAndFall) {
  const auto truth = [](double pairs) { return 0.9 - 2.0 * std::pow(pairs - 0.75, 2); };
  const auto curve = cbm::CrowdedArea::through(fit_crowded_area(packings(truth), 0.1).knots);
  ASSERT_TRUE(curve.ok());
  for (double pairs = 0.53; pairs < 0.87; pairs += 0.01) EXPECT_NEAR(curve->at(pairs), truth(pairs), 0.005) << pairs;
}

TEST(CrowdedArea, OfNothingIsNone) {
  EXPECT_TRUE(fit_crowded_area({}, 0.1).knots.empty());
  EXPECT_TRUE(fit_crowded_area(packings([](double pairs) { return pairs; }, true), 0.1).knots.empty()) << "all held out";
  auto lattices = packings([](double pairs) { return pairs; });
  for (PackingPoint& p : lattices) p.arrangement = Arrangement::kFaceCentred;
  EXPECT_TRUE(fit_crowded_area(lattices, 0.1).knots.empty());
  EXPECT_TRUE(fit_crowded_area(packings([](double) { return 0.0; }), 0.1).knots.empty()) << "areas that were not measured";
}

}  // namespace
}  // namespace morula::calibrate
