#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "core/simd/atan2.h"
#include "core/simd/transpose.h"

namespace morula {
namespace {

TEST(LaneAtan2, AgreesWithTheLibraryToAFewUlp) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200000; ++i) {
    const double scale = std::exp(10.0 * normal(engine));
    const double y = normal(engine) * (i % 2 ? 1.0 : scale), x = normal(engine);
    const double expected = std::atan2(y, x);
    ASSERT_NEAR(lane_atan2(y, x), expected, 1e-15 * std::abs(expected) + 1e-300) << y << " " << x;
  }
}

TEST(LaneAtan2, IsExactOnTheAxesAndQuietAtTheOrigin) {
  EXPECT_EQ(lane_atan2(0.0, 0.0), 0.0);
  EXPECT_EQ(lane_atan2(0.0, 2.0), 0.0);
  EXPECT_EQ(lane_atan2(3.0, 0.0), std::numbers::pi / 2);
  EXPECT_EQ(lane_atan2(-3.0, 0.0), -std::numbers::pi / 2);
  EXPECT_EQ(lane_atan2(0.0, -2.0), std::numbers::pi);
  EXPECT_EQ(lane_atan2(1.0, 1.0), std::numbers::pi / 4);
  EXPECT_TRUE(std::isnan(lane_atan2(std::nan(""), 1.0)));
}

TEST(LaneAtan2, GivesTheSameBitsInEveryLane) {
  std::mt19937_64 engine(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    Lane<double, 8> y(0.0), x(0.0);
    for (int lane = 0; lane < 8; ++lane) y.set(lane, normal(engine)), x.set(lane, normal(engine));
    const auto angle = lane_atan2(y, x);
    for (int lane = 0; lane < 8; ++lane) {
      ASSERT_EQ(angle[lane], lane_atan2(y[lane], x[lane]));
      ASSERT_EQ(angle[lane], lane_atan2(Lane<double, 1>(y[lane]), Lane<double, 1>(x[lane]))[0]);
    }
  }
}

template <int W, class T>
void expect_round_trip() {
  for (const std::size_t count : {0u, 1u, 7u, 8u, 29u, 64u}) {
    std::vector<std::vector<T>> rows(W, std::vector<T>(count)), back(W, std::vector<T>(count));
    std::array<const T*, W> source;
    std::array<T*, W> target;
    for (int lane = 0; lane < W; ++lane) {
      for (std::size_t i = 0; i < count; ++i) rows[lane][i] = static_cast<T>(1000 * lane + static_cast<int>(i));
      source[lane] = rows[lane].data();
      target[lane] = back[lane].data();
    }
    LaneVector<T> lanes(count * W);
    load_lanes<W, T>(source, count, lanes.data());
    for (std::size_t i = 0; i < count; ++i) {
      for (int lane = 0; lane < W; ++lane) ASSERT_EQ(lanes[i * W + lane], rows[lane][i]);
    }
    store_lanes<W, T>(lanes.data(), count, target);
    EXPECT_EQ(rows, back);
  }
}

TEST(LaneTranspose, PutsElementsOfCellsSideBySideAndBack) {
  expect_round_trip<1, double>();
  expect_round_trip<4, double>();
  expect_round_trip<8, double>();
  expect_round_trip<1, float>();
  expect_round_trip<4, float>();
  expect_round_trip<8, float>();
}

}  // namespace
}  // namespace morula
