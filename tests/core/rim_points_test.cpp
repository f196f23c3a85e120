#include "core/contact/rim_points.h"

#include <gtest/gtest.h>

#include "core/contact/traction_law.h"

namespace morula {
namespace {

constexpr double kRange = 0.5, kOut = 1e300;

RimWeight weight(double a, double b, double c) {
  const double gap[RimWeight::kMostPoints] = {a, b, c, kOut};
  return RimWeight::of(gap, 3, kRange);
}

TEST(RimPoints, AreThoseOfFacesThatAreNeitherInTouchNorOutOfRange) {
  EXPECT_EQ(weight(-0.1, 0.0, 0.05).value, 0.0) << "in touch as a whole";
  EXPECT_EQ(weight(0.5, 0.6, kOut).value, 0.0) << "out of range as a whole";
  EXPECT_EQ(weight(0.0, 0.3, kOut).value, 1.0);
  EXPECT_EQ(weight(0.3, kOut, kOut).value, 1.0);
  EXPECT_GT(weight(0.48, kOut, kOut).value, 0.0) << "on the way in";
  EXPECT_LT(weight(0.48, kOut, kOut).value, 1.0);
}

TEST(RimPoints, HaveAWeightWhoseSlopeIsItsDerivative) {
  for (const double a : {-0.02, 0.06, 0.09, 0.17, 0.3, 0.4, 0.46})
    for (const double b : {0.02, 0.08, 0.42})
      for (const double c : {0.07, 0.47, 0.49}) {
        const double h = 1e-6;
        const RimWeight at = weight(a, b, c);
        EXPECT_NEAR(at.slope[0], (weight(a + h, b, c).value - weight(a - h, b, c).value) / (2.0 * h), 1e-4) << a << ' ' << b << ' ' << c;
        EXPECT_NEAR(at.slope[1], (weight(a, b + h, c).value - weight(a, b - h, c).value) / (2.0 * h), 1e-4);
        EXPECT_NEAR(at.slope[2], (weight(a, b, c + h).value - weight(a, b, c - h).value) / (2.0 * h), 1e-4);
      }
}

/// Means over the points of x and x² over the corners' coordinates against those over the triangle, 1/3 and 1/6: both sets are exact to first order, three points
/// to second order; nine lack the second moment of their sub-triangles, a ninth of (1/6 − 1/9).
TEST(RimPoints, StandForEqualPartsOfTheirFace) {
  for (const int points : {3, 4}) {
    const FaceQuadrature& quadrature = FaceQuadrature::with_points(points);
    EXPECT_EQ(quadrature.kept(), points + 9);
    EXPECT_EQ(quadrature.kept_at(FaceQuadrature::kFirstFine), static_cast<std::size_t>(points));
    for (std::size_t i = 0; i < 3; ++i) {
      double coarse = 0.0, fine = 0.0, square = 0.0;
      for (int q = 0; q < quadrature.count; ++q) coarse += quadrature.weight[q][i] / quadrature.count;
      for (int q = FaceQuadrature::kFirstFine; q < FaceQuadrature::kNumbers; ++q) {
        fine += quadrature.weight[q][i] / FaceQuadrature::kFine;
        square += quadrature.weight[q][i] * quadrature.weight[q][i] / FaceQuadrature::kFine;
      }
      EXPECT_NEAR(coarse, 1.0 / 3.0, 1e-15);
      EXPECT_NEAR(fine, 1.0 / 3.0, 1e-15);
      EXPECT_NEAR(square, 1.0 / 6.0 - (1.0 / 6.0 - 1.0 / 9.0) / 9.0, 1e-15);
    }
  }
}

}  // namespace
}  // namespace morula
