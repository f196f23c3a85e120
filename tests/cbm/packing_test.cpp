/// Caps of overlapping spheres and the pressure of packing: numbers of cbm.md §3.
#include "cbm/packing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cbm/laws/sphere_caps.h"

namespace morula::cbm {
namespace {

PackingCurve ideal(double bulk_modulus = 2.5) { return PackingCurve::through(ideal_filled_cell(bulk_modulus, 0.45, 0.4).value()).value(); }

double fcc_packing(double s) { return 3.0 * s * s * (3.0 - s); }

/// p_c of the ideal filled cell, straight from its definition (R 6, E 0.45, ν 0.4, W 0, K_V 2.5).
double wanted_pressure(double s) {
  const double modulus = 0.45 / (2.0 * (1.0 - 0.16)), confluent = 1.0 - 0.5 * std::cbrt(4.0 * std::numbers::sqrt2 * std::numbers::pi / 3.0);
  const double target = -3.0 * 2.5 * std::log((1.0 - s) / (1.0 - confluent));
  const double hertz = 4.0 * std::numbers::sqrt2 / 3.0 * modulus * std::pow(s, 1.5) / ((1.0 - s) * (1.0 - s));
  const double ratio = 0.5 / (1.0 - s);
  return std::max(0.0, target - hertz) / (2.0 * std::numbers::sqrt2 * std::numbers::pi * (ratio * ratio - 0.25));
}

TEST(SphereCaps, HaveTheReferenceVolumesAndSlopes) {
  const SphereCaps caps = sphere_caps(6.0, 5.0, 9.5);
  EXPECT_NEAR(caps.volume_a, 8.1717292, 5e-8);
  EXPECT_NEAR(caps.volume_b, 10.1972870, 5e-8);
  EXPECT_NEAR(caps.slope_a, 10.4861986, 5e-8);
  EXPECT_NEAR(caps.slope_b, 13.3971938, 5e-8);
  EXPECT_NEAR((caps.slope_a + caps.slope_b) / std::numbers::pi, 7.6023199, 5e-8);  // a_g²: the two shares make the disc
  const SphereCaps equal = sphere_caps(5.0, 5.0, 8.0);
  EXPECT_NEAR(equal.volume_a, 14.6607657, 5e-8);
  EXPECT_EQ(equal.volume_a, equal.volume_b);
  EXPECT_NEAR((equal.slope_a + equal.slope_b) / std::numbers::pi, 9.0, 1e-12);
  EXPECT_NEAR(equal.volume_a / (4.0 / 3.0 * std::numbers::pi * 125.0), 0.028, 1e-12);
}

TEST(SphereCaps, ChangeAsTheirSlopesSay) {
  const double h = 1e-5;
  for (const double b : {5.0, 6.0, 7.3})
    for (double d = std::abs(6.0 - b) + 0.3; d < 6.0 + b - 0.1; d += 0.37) {
      const SphereCaps low = sphere_caps(6.0, b, d - h), here = sphere_caps(6.0, b, d), high = sphere_caps(6.0, b, d + h);
      EXPECT_NEAR(-(high.volume_a - low.volume_a) / (2.0 * h), here.slope_a, 1e-6 * (1.0 + std::abs(here.slope_a))) << b << ' ' << d;
      EXPECT_NEAR(-(high.volume_b - low.volume_b) / (2.0 * h), here.slope_b, 1e-6 * (1.0 + std::abs(here.slope_b))) << b << ' ' << d;
      EXPECT_NEAR(-(high.slope_a - low.slope_a) / (2.0 * h), here.curvature_a, 1e-6 * (1.0 + std::abs(here.curvature_a))) << b << ' ' << d;
      EXPECT_NEAR(-(high.slope_b - low.slope_b) / (2.0 * h), here.curvature_b, 1e-6 * (1.0 + std::abs(here.curvature_b))) << b << ' ' << d;
    }
}

TEST(SphereCaps, GoOverToTheWholeSmallSphereWithoutAJump) {
  const double whole = 4.0 / 3.0 * std::numbers::pi * 27.0;
  for (const double d : {0.0, 1.0, 2.0 - 1e-9, 2.0 + 1e-9}) {
    const SphereCaps caps = sphere_caps(5.0, 3.0, d);
    EXPECT_NEAR(caps.volume_a, 0.0, 1e-6) << d;
    EXPECT_NEAR(caps.volume_b, whole, 1e-6) << d;
    EXPECT_NEAR(caps.slope_a + caps.slope_b, 0.0, 1e-6) << d;
  }
}

TEST(PlaneCap, IsHalfOfTheCapsOfTwoEqualSpheres) {
  for (const double overlap : {0.1, 1.0, 3.0}) {
    EXPECT_NEAR(plane_cap(6.0, overlap).volume, sphere_caps(6.0, 6.0, 12.0 - 2.0 * overlap).volume_a, 1e-12);
    EXPECT_NEAR(plane_cap(6.0, overlap).slope, 2.0 * sphere_caps(6.0, 6.0, 12.0 - 2.0 * overlap).slope_a,
                1e-12);  // one side moves twice as far
  }
  EXPECT_EQ(plane_cap(6.0, -0.1).volume, 0.0);
}

TEST(Packing, IdealFilledCellHasTheReferenceKnots) {
  const auto knots = ideal_filled_cell(2.5, 0.45, 0.4).value();
  ASSERT_EQ(knots.size(), 8u);
  EXPECT_NEAR(knots[0].packing, 0.0829053, 5e-8);
  EXPECT_EQ(knots[0].pressure, 0.0);
  const double packing[] = {0.08700, 0.10491, 0.12442, 0.16817, 0.21811, 0.33600, 0.51562};
  const double pressure[] = {37.13, 170.83, 278.91, 440.16, 551.00, 681.72, 749.07};  // Pa
  for (std::size_t k = 0; k < 7; ++k) {
    EXPECT_NEAR(knots[k + 1].packing, packing[k], 5.1e-6);
    EXPECT_NEAR(1000.0 * knots[k + 1].pressure, pressure[k], 5.1e-3);
  }
}

TEST(Packing, EightKnotsKeepThePressureWithin1Point2Percent) {
  const PackingCurve curve = ideal();
  double most = 0.0;
  for (double s = 0.0975; s <= 0.25; s += 1e-5)
    if (const double wanted = wanted_pressure(s); wanted > 0.03)
      most = std::max(most, std::abs(curve.at(fcc_packing(s)).pressure / wanted - 1.0));
  EXPECT_LT(most, 0.0125);  // cbm.md §3: 1.2 % wherever p_c > 30 Pa
}

TEST(Packing, CurveIsMonotoneAndItsPartsAreDerivatives) {
  for (const PackingCurve& curve :
       {ideal(),
        PackingCurve::through(std::vector<PackingKnot>{{0.02, 0.0}, {0.03, 0.5}, {0.05, 0.5}, {0.051, 0.9}, {0.3, 0.91}}).value()}) {
    const double end = 1.6 * curve.last(), step = end / 10000.0;
    double before = 0.0;
    for (int k = 0; k <= 10000; ++k) {
      const auto value = curve.at(k * step);
      EXPECT_GE(value.pressure, before);
      EXPECT_GE(value.slope, 0.0);
      before = value.pressure;
      const double h = 1e-6;
      const auto low = curve.at(k * step - h), high = curve.at(k * step + h);
      EXPECT_NEAR((high.energy - low.energy) / (2.0 * h), value.pressure, 1e-3 * curve.steepest() * step + 1e-7) << k;
      if (std::abs(k * step - curve.onset()) < 2.0 * h) continue;  // the slope begins with a step
      EXPECT_NEAR((high.pressure - low.pressure) / (2.0 * h), value.slope, 1e-2 * curve.steepest()) << k;
    }
  }
}

TEST(Packing, GoesOnAsAStraightLineBeyondTheLastKnot) {
  const PackingCurve rising = PackingCurve::through(std::vector<PackingKnot>{{0.02, 0.0}, {0.03, 0.1}, {0.05, 0.4}}).value();
  EXPECT_GT(rising.at(rising.last()).slope, 0.0);
  for (const PackingCurve& curve : {rising, ideal()}) {
    const auto end = curve.at(curve.last()), beyond = curve.at(1.5 * curve.last());
    EXPECT_NEAR(beyond.slope, end.slope, 1e-12);
    EXPECT_NEAR(beyond.pressure, end.pressure + 0.5 * curve.last() * end.slope, 1e-12);
    EXPECT_EQ(curve.at(curve.onset()).pressure, 0.0);
  }
  EXPECT_EQ(PackingCurve().at(0.5).pressure, 0.0);
}

TEST(Packing, RefusesKnotsThatAreNoCurve) {
  const auto refused = [](std::vector<PackingKnot> knots) { return !PackingCurve::through(knots).ok(); };
  EXPECT_TRUE(refused({{0.1, 0.0}, {0.2, 0.1}}));
  EXPECT_TRUE(refused({{0.0, 0.0}, {0.1, 0.1}, {0.2, 0.2}}));
  EXPECT_TRUE(refused({{0.1, 0.01}, {0.2, 0.1}, {0.3, 0.2}}));
  EXPECT_TRUE(refused({{0.1, 0.0}, {0.1, 0.1}, {0.3, 0.2}}));
  EXPECT_TRUE(refused({{0.1, 0.0}, {0.2, 0.2}, {0.3, 0.1}}));
  EXPECT_FALSE(refused({{0.1, 0.0}, {0.2, 0.1}, {0.3, 0.1}}));
  EXPECT_FALSE(ideal_filled_cell(0.05, 0.45, 0.4).ok());  // spheres of 450 Pa are stiffer than such a bag
}

}  // namespace
}  // namespace morula::cbm
