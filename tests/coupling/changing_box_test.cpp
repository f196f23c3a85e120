#include "coupling/changing_box.h"

#include <gtest/gtest.h>

#include <cmath>

namespace morula {
namespace {

const Box kBox{{-10, 0, 5}, {10, 30, 25}};
const TimeCourse kCourse{{0.0, 100.0, 200.0}, {1.0, 1.0, 0.5}};

TEST(ChangingBox, IsThatOfTheStudyWithoutACourse) {
  EXPECT_EQ(box_at(kBox, {}, 50.0).low, kBox.low);
  EXPECT_EQ(box_at(kBox, {}, 50.0).high, kBox.high);
}

TEST(ChangingBox, HasTheVolumeOfTheCourseAroundTheSameCentre) {
  for (const double time : {0.0, 100.0, 130.0, 200.0, 1000.0}) {
    const Box now = box_at(kBox, kCourse, time);
    const Vec3d size = now.size();
    EXPECT_NEAR(size.x * size.y * size.z, 20.0 * 30.0 * 20.0 * kCourse.at(time), 1e-9) << time;
    EXPECT_NEAR(size.y / size.x, 1.5, 1e-14);
    EXPECT_NEAR(norm(now.center() - kBox.center()), 0.0, 1e-13);
  }
}

TEST(ChangingBox, AllPlacesKeepTheirShareOfIt) {
  Tissue tissue;
  tissue.spheres.position = {{-10, 0, 5}, {3, 7, 11}};
  tissue.shells.position = {{1, 2, 6}};
  tissue.shells.nucleus = {std::nullopt, Vec3d{4, 20, 9}};
  tissue.nuclei.shells.position = {{9, 29, 24}};
  const Tissue before = tissue;
  const Box to = box_at(kBox, kCourse, 200.0);
  carry(tissue, kBox, to);
  const auto expect_same_share = [&](const Vec3d& was, const Vec3d& is) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR((is[axis] - to.low[axis]) / to.size()[axis], (was[axis] - kBox.low[axis]) / kBox.size()[axis], 1e-14);
  };
  for (std::size_t i = 0; i < 2; ++i) expect_same_share(before.spheres.position[i], tissue.spheres.position[i]);
  expect_same_share(before.shells.position[0], tissue.shells.position[0]);
  expect_same_share(*before.shells.nucleus[1], *tissue.shells.nucleus[1]);
  expect_same_share(before.nuclei.shells.position[0], tissue.nuclei.shells.position[0]);
  EXPECT_FALSE(tissue.shells.nucleus[0].has_value());
}

TEST(ChangingBox, AStepMovesNoSurfaceFurtherFromItsCentreThanAllowed) {
  constexpr double kRadius = 6.0, kAllowed = 0.01;
  const double step = longest_carried_step(kCourse, 100.0, 200.0, kRadius, kAllowed);
  ASSERT_LT(step, 100.0);
  const double strain = 1.0 - std::cbrt(kCourse.at(100.0 + step) / kCourse.at(100.0));
  EXPECT_NEAR(strain * kRadius, kAllowed, 0.01 * kAllowed);
  EXPECT_GT(longest_carried_step(kCourse, 0.0, 100.0, kRadius, kAllowed), 1e300) << "at rest";
}

}  // namespace
}  // namespace morula
