// The gap over the part of a face that a quadrature point stands for (decision 0048).
#include "core/contact/gap_spread.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/contact/traction_law.h"
#include "core/mesh/face_quadrature.h"

namespace morula {
namespace {

constexpr double kRange = 0.5;

TEST(GapSpread, IsNoneWhereSurfacesLookAtEachOther) {
  for (const double m : {1.0, 0.98, -0.98}) {
    const auto spread = GapSpread<double>::of(m, 0.5, kRange);
    EXPECT_EQ(spread.half, 0.0);
    EXPECT_EQ(spread.by_opposition, 0.0);
    EXPECT_EQ(spread.by_area, 0.0);
  }
  EXPECT_GT(GapSpread<double>::of(0.9, 0.5, kRange).half, 0.05);
  for (const double area : {1.0, 100.0}) EXPECT_LT(GapSpread<double>::of(0.0, area, kRange).half, most_spread(kRange));
}

TEST(GapSpread, HasTheSlopesOfItsSquare) {
  constexpr double kStep = 1e-6;
  const auto square = [](double m, double area) { return std::pow(GapSpread<double>::of(m, area, kRange).half, 2.0); };
  for (const double area : {0.1, 0.5, 5.0})
    for (double m = -0.95; m < 0.96; m += 0.05) {
      const auto spread = GapSpread<double>::of(m, area, kRange);
      EXPECT_NEAR(spread.by_opposition, (square(m + kStep, area) - square(m - kStep, area)) / (2.0 * kStep), 1e-7);
      EXPECT_NEAR(spread.by_area, (square(m, area + kStep) - square(m, area - kStep)) / (2.0 * kStep), 1e-7);
    }
}

/// Energy of the tent over a flat equilateral face with edges of 1.8 µm (162 nodes on 6 µm) that is tilted against a plane, over that of the whole
/// face in contact. `angle`: direction of the steepest line; `turn`: tilt [rad]; `height`: gap at the centroid [µm].
struct TiltedFace {
  double angle, turn, height;

  [[nodiscard]] double gap(const std::array<double, 3>& beta) const {
    double out = height;
    for (std::size_t k = 0; k < 3; ++k)
      out += beta[k] * (1.8 / std::sqrt(3.0)) * std::sin(turn) * std::cos(angle + 2.0943951023931953 * static_cast<double>(k));
    return out;
  }
  /// By a hundred rows of sub-triangles.
  [[nodiscard]] double exact(const TractionLaw& law) const {
    constexpr int kRows = 100;
    double sum = 0.0;
    for (int i = 0; i < kRows; ++i)
      for (int j = 0; j < kRows - i; ++j)
        for (int upper = 0; upper < (j + 1 < kRows - i ? 2 : 1); ++upper) {
          const double u = (i + (1.0 + upper) / 3.0) / kRows, v = (j + (1.0 + upper) / 3.0) / kRows;
          sum += law.attraction(gap({1.0 - u - v, u, v})).energy;
        }
    return -sum / (kRows * kRows);
  }
  /// By the points of a face, each with three gaps that are `half` apart.
  [[nodiscard]] double by_points(const TractionLaw& law, double half) const {
    const FaceQuadrature& rule = FaceQuadrature::with_points(3);
    double sum = 0.0;
    for (int q = 0; q < rule.count; ++q) {
      const double g = gap({rule.weight[q][0], rule.weight[q][1], rule.weight[q][2]});
      for (const double sample : {g - half, g, g + half}) sum += law.attraction(sample).energy;
    }
    return -sum / (3.0 * rule.count);
  }
};

/// The energy of a face at the rim comes nearer to that of a face that is integrated finely, over all places that it may have against the range.
TEST(GapSpread, BringsTheEnergyOfAFaceAtTheRimNearerToItsIntegral) {
  const TractionLaw law{.adhesion = 1.0, .range = kRange};
  const double area = std::sqrt(3.0) / 4.0 * 1.8 * 1.8 / 3.0;
  for (const double turn : {0.7, 0.9, 1.2}) {
    const double half = GapSpread<double>::of(std::cos(turn), area, kRange).half;
    double plain = 0.0, spread = 0.0;
    int faces = 0;
    for (int direction = 0; direction < 6; ++direction)
      for (double height = -0.4; height < 1.0; height += 0.1, ++faces) {
        const TiltedFace face{0.35 * direction, turn, height};
        const double exact = face.exact(law);
        plain += std::pow(face.by_points(law, 0.0) - exact, 2.0);
        spread += std::pow(face.by_points(law, half) - exact, 2.0);
      }
    EXPECT_LT(std::sqrt(spread / faces), 0.75 * std::sqrt(plain / faces)) << "at a tilt of " << turn;
    EXPECT_GT(std::sqrt(plain / faces), 0.01);
  }
}

}  // namespace
}  // namespace morula
