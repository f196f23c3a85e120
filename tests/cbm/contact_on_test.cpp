#include "cbm/contact_on.h"

#include <gtest/gtest.h>

#include "tests/cbm/hertz_ellipse.h"

namespace morula::cbm {
namespace {

/// Rods from three times as wide as the cell to a fiftieth of it.
TEST(ContactOn, IsHertzEllipse) {
  constexpr double kRadius = 6.0;
  for (const double rod : {18.0, 6.0, 3.0, 1.0, 0.3, 0.12}) {
    const HertzEllipse asked = hertz_ellipse(1.0 / kRadius + 1.0 / rod, 1.0 / kRadius, 1.0, 1.0);
    const ContactOn on = contact_on(kRadius, {.mean = 0.5 / rod, .gaussian = 0.0});
    const double overlap = std::cbrt(9.0 / (16.0 * on.radius));  // of F = 4/3 E* √R* δ^(3/2)
    EXPECT_NEAR(overlap / asked.overlap, 1.0, 0.005) << rod;
    EXPECT_NEAR(on.area * std::numbers::pi * on.radius * overlap / asked.area, 1.0, 0.01) << rod;
  }
}

TEST(ContactOn, IsRoundOnPlanesAndBalls) {
  const ContactOn plane = contact_on(6.0, {}), ball = contact_on(6.0, {.mean = 0.5, .gaussian = 0.25});
  EXPECT_EQ(plane.radius, 6.0);
  EXPECT_EQ(plane.area, 1.0);
  EXPECT_DOUBLE_EQ(ball.radius, 1.5);  // of 6 and 2 µm
  EXPECT_EQ(ball.area, 1.0);
}

}  // namespace
}  // namespace morula::cbm
