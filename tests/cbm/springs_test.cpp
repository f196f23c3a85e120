// Springs between spheres by numbers computed by hand; that force, slope and energy go together is tested for every law of the registry.
#include "cbm/laws/springs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cbm/spheres.h"

namespace morula::cbm {
namespace {

SphereParameters sphere(const std::shared_ptr<const SphereLaw>& law, double stiffness, double length) {
  SphereParameters out{1.5, 0.4, law};
  out.own.set("spring_stiffness", stiffness), out.own.set("spring_length", length);
  return out;
}

/// Two equal spheres of k = 2 nN/µm and l = 0.5 µm, R* = 3 µm.
ContactResponse<double> at(const std::shared_ptr<const SphereLaw>& law, double overlap) {
  const SphereParameters one = sphere(law, 2.0, 0.5);
  return law->respond({law.get(), law->couple(one, &one, 0.1)}, 3.0, overlap, false).response;
}

TEST(Springs, HaveTheForcesOfTheirFormulas) {
  // At 1 µm, twice the length: 2·1, 2·1²/0.5, 2·0.5·ln 3; energies ½·2, 4/3, 2·0.25·(3 ln 3 − 2).
  EXPECT_DOUBLE_EQ(at(linear_law(), 1.0).force, 2.0);
  EXPECT_DOUBLE_EQ(at(linear_law(), 1.0).energy, 1.0);
  EXPECT_DOUBLE_EQ(at(quadratic_law(), 1.0).force, 4.0);
  EXPECT_DOUBLE_EQ(at(quadratic_law(), 1.0).stiffness, 8.0);
  EXPECT_DOUBLE_EQ(at(quadratic_law(), 1.0).energy, 4.0 / 3.0);
  EXPECT_NEAR(at(logarithmic_law(), 1.0).force, 1.0986122886681098, 1e-15);
  EXPECT_NEAR(at(logarithmic_law(), 1.0).stiffness, 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(at(logarithmic_law(), 1.0).energy, 0.6479184330021643, 1e-15);
  for (const auto& law : {linear_law(), quadratic_law(), logarithmic_law()}) {
    EXPECT_DOUBLE_EQ(at(law, 0.5).area, 3.14159265358979323846 * 3.0 * 0.5);
    const ContactResponse<double> apart = at(law, -0.1);
    EXPECT_EQ(apart.force, 0.0);
    EXPECT_EQ(apart.stiffness, 0.0);
    EXPECT_EQ(apart.energy, 0.0);
  }
}

TEST(Springs, ThatBendAreLinearForSmallOverlapsOrTouchAtTheLength) {
  EXPECT_NEAR(at(logarithmic_law(), 1e-6).force / at(linear_law(), 1e-6).force, 1.0, 1.1e-6);
  EXPECT_DOUBLE_EQ(at(quadratic_law(), 0.5).force, at(linear_law(), 0.5).force);
}

TEST(Springs, OfTwoTypesLieInSeries) {
  const SphereParameters soft = sphere(logarithmic_law(), 1.0, 0.5), stiff = sphere(logarithmic_law(), 3.0, 1.5);
  const PairCoefficients pair = logarithmic_law()->couple(soft, &stiff, 0.0);
  EXPECT_DOUBLE_EQ(pair[0], 1.5);
  EXPECT_DOUBLE_EQ(pair[1], 1.0);
  EXPECT_EQ(logarithmic_law()->couple(stiff, &soft, 0.0), pair);
  EXPECT_DOUBLE_EQ(linear_law()->couple(stiff, nullptr, 0.0)[0], 3.0);
}

}  // namespace
}  // namespace morula::cbm
