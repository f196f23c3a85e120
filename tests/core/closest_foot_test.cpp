#include "core/contact/closest_foot.h"

#include <gtest/gtest.h>

#include <random>

namespace morula {
namespace {

TEST(ClosestFoot, GivesTheSameBitsInLanesAndAgreesWithTheRegionTest) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  using Real = Lane<double, 8>;
  int regions[3] = {0, 0, 0};  // by number of weights that are zero
  for (int round = 0; round < 400; ++round) {
    Vec3d x[4][8];
    Vec3<Real> lanes[4];
    for (int k = 0; k < 4; ++k)
      for (int lane = 0; lane < 8; ++lane) {
        Vec3d& v = x[k][lane];
        v = {uniform(engine), uniform(engine), round % 2 == 0 ? uniform(engine) : 0.0};  // every other in one plane
        lanes[k].x.set(lane, v.x), lanes[k].y.set(lane, v.y), lanes[k].z.set(lane, v.z);
      }
    const auto foot = closest_foot<Real>(lanes[0], lanes[1], lanes[2], lanes[3]);
    for (int lane = 0; lane < 8; ++lane) {
      const auto one = closest_foot<double>(x[0][lane], x[1][lane], x[2][lane], x[3][lane]);
      EXPECT_EQ(one.distance2, foot.distance2[lane]);
      for (int k = 0; k < 3; ++k) EXPECT_EQ(one.mu[k], foot.mu[k][lane]);
      const auto sure = closest_foot_of(x[0][lane], x[1][lane], x[2][lane], x[3][lane]);
      const ClosestPoint expected = closest_point_on_triangle(x[0][lane], x[1][lane], x[2][lane], x[3][lane]);
      EXPECT_NEAR(sure.distance2, expected.distance2, 1e-10);
      EXPECT_NEAR(norm(x[0][lane] - sure.away - expected.point), 0.0, 1e-7);
      int zeros = 0, expected_zeros = 0;
      for (int k = 0; k < 3; ++k) {
        zeros += sure.mu[k] == 0.0;
        expected_zeros += expected.barycentric[k] == 0.0;
      }
      EXPECT_EQ(zeros, expected_zeros);
      ++regions[zeros];
    }
  }
  for (const int count : regions) EXPECT_GT(count, 100);  // face, edges and corners were all met
}

TEST(ClosestFoot, AsksTheRobustTestForSlivers) {
  const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{0.5, 1e-5, 0};
  EXPECT_EQ(closest_foot<double>({0.5, 0.3, 0.2}, a, b, c).doubtful, 1.0);
  EXPECT_NEAR(closest_foot_of({0.5, 0.3, 0.2}, a, b, c).distance2, (0.3 - 1e-5) * (0.3 - 1e-5) + 0.04, 1e-12);
  const auto point = closest_foot_of({1, 2, 2}, a, a, a);
  EXPECT_NEAR(point.distance2, 9.0, 1e-12);
}

}  // namespace
}  // namespace morula
