#include "core/contact/common_drift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace morula {
namespace {

std::vector<Vec3f> places(std::size_t count, double thickness) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-50.0, 50.0);
  std::vector<Vec3f> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(to_float(Vec3d{at(random) + 20.0, at(random), thickness * at(random)}));
  return out;
}

Vec3d to_double(const Vec3f& v) { return {v.x, v.y, v.z}; }

/// A swelling by 1 % with a shear, a turn and a shift: nothing is left of it.
TEST(CommonDrift, IsAnyMotionThatIsLinearInThePlace) {
  const std::vector<Vec3f> before = places(5000, 1.0);
  std::vector<Vec3d> now;
  const auto moved = [](const Vec3d& x) {
    return x + Vec3d{0.01 * x.x + 0.002 * x.y + 0.3, 0.01 * x.y - 0.004 * x.z, 0.01 * x.z + 0.001 * x.x - 0.7};
  };
  for (const Vec3f& x : before) now.push_back(moved(to_double(x)));
  const CommonDrift drift = common_drift(before, now);
  for (std::size_t i = 0; i < before.size(); i += 13) {
    const Vec3d x = to_double(before[i]);
    EXPECT_LT(norm(x + drift.at(x) - now[i]), 1e-10);
  }
  EXPECT_NEAR(drift.strain, std::sqrt(3 * 1e-4 + 4e-6 + 16e-6 + 1e-6), 1e-9);
}

TEST(CommonDrift, IsNoneOfFewPointsAndShiftAloneOfFlatOnes) {
  std::vector<Vec3f> before = places(40, 1.0);
  EXPECT_EQ(common_drift(before, std::vector<Vec3d>(40, Vec3d{1, 1, 1})).strain, 0.0);
  EXPECT_EQ(norm(common_drift(before, std::vector<Vec3d>(40, Vec3d{1, 1, 1})).way), 0.0);
  before = places(400, 0.0);
  std::vector<Vec3d> now;
  for (const Vec3f& x : before) now.push_back(to_double(x) * 1.01 + Vec3d{0, 0, 2});
  const CommonDrift flat = common_drift(before, now);
  EXPECT_EQ(flat.strain, 0.0);
  EXPECT_NEAR(flat.way.z, 2.0, 1e-6);
}

}  // namespace
}  // namespace morula
