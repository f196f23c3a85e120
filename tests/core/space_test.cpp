#include "core/space/space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace morula {
namespace {

constexpr auto kP = BoundaryKind::kPeriodic;
constexpr auto kW = BoundaryKind::kWall;
constexpr auto kO = BoundaryKind::kOpen;

/// 100 × 40 × 30 µm, periodic along x and y.
Space slab() { return {{{-50, 0, 10}, {50, 40, 40}}, {{{kP, kP}, {kP, kP}, {kW, kO}}}}; }

TEST(Space, KnowsItsPeriodicAxes) {
  EXPECT_TRUE(slab().periodic(0));
  EXPECT_FALSE(slab().periodic(2));
  EXPECT_TRUE(slab().any_periodic());
  EXPECT_FALSE(Space{}.any_periodic());
}

TEST(Space, NearestImageIsTheShortestOfAllImages) {
  const Space space = slab();
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> any(-150.0, 150.0);
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3d d{any(random), any(random), any(random)};
    const Vec3d nearest = space.nearest_image(d);
    EXPECT_EQ(nearest.z, d.z);
    double shortest = 1e300;
    for (int i = -5; i <= 5; ++i)
      for (int j = -5; j <= 5; ++j) shortest = std::min(shortest, norm2(d + Vec3d{100.0 * i, 40.0 * j, 0.0}));
    EXPECT_NEAR(norm2(nearest), shortest, 1e-9);
  }
}

TEST(Space, NearestImageIsOppositeSeenFromTheOtherSide) {
  const Space space = slab();
  for (const Vec3d d : {Vec3d{50, 20, 3}, Vec3d{-50, -20, 1}, Vec3d{49.9, 61, -4}, Vec3d{150, 100, 0}})  // ties included
    EXPECT_EQ(space.nearest_image(-d), -space.nearest_image(d));
}

TEST(Space, WrappedPointsLieInsideAndDifferByWholePeriods) {
  const Space space = slab();
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> any(-500.0, 500.0);
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3d p{any(random), any(random), any(random)};
    const Vec3d inside = space.wrapped(p);
    EXPECT_GE(inside.x, -50.0);
    EXPECT_LT(inside.x, 50.0);
    EXPECT_GE(inside.y, 0.0);
    EXPECT_LT(inside.y, 40.0);
    EXPECT_EQ(inside.z, p.z);
    EXPECT_NEAR(std::remainder(inside.x - p.x, 100.0), 0.0, 1e-11);
    EXPECT_NEAR(std::remainder(inside.y - p.y, 40.0), 0.0, 1e-11);
    EXPECT_EQ(space.wrapped(inside), inside);
  }
}

TEST(Space, WrappingNeverEndsOnTheHighFace) {
  const Space space = slab();
  EXPECT_EQ(space.wrapped({50, 40, 20}), (Vec3d{-50, 0, 20}));
  const double just_below = -1e-18;  // + 40 rounds to 40
  EXPECT_EQ(space.wrapped({0, just_below, 20}).y, 0.0);
  const Vec3d near{std::nextafter(-50.0, -60.0), std::nextafter(40.0, 50.0), 0};
  EXPECT_LT(space.wrapped(near).x, 50.0);
  EXPECT_LT(space.wrapped(near).y, 40.0);
}

TEST(Space, PointsInsideStayBitForBit) {
  const Space space = slab();
  for (const Vec3d p : {Vec3d{-50, 0, 10}, Vec3d{49.999999999999993, 39.999999999999993, 0}, Vec3d{0.1, 0.3, 1e9}})
    EXPECT_EQ(space.wrapped(p), p);
}

TEST(Box, IncludesInflatesAndOverlaps) {
  Box box;
  EXPECT_TRUE(box.empty());
  box.include(Vec3d{1, 2, 3});
  box.include(Vec3d{-1, 5, 0});
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box.size(), (Vec3d{2, 3, 3}));
  EXPECT_EQ(box.center(), (Vec3d{0, 3.5, 1.5}));
  EXPECT_TRUE(box.contains({0, 3, 1}));
  EXPECT_FALSE(box.contains({0, 1, 1}));
  const Box beside{{1.5, 2, 0}, {3, 5, 3}};
  EXPECT_FALSE(box.overlaps(beside));
  EXPECT_TRUE(box.inflated(0.5).overlaps(beside));
  EXPECT_FALSE(Box{}.overlaps(box));
}

}  // namespace
}  // namespace morula
