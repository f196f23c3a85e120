/// How far contacts are within what their law is for.
#include "cbm/sphere_range.h"

#include <gtest/gtest.h>

#include <numbers>

namespace morula::cbm {
namespace {

TEST(PartOfRange, OfALawThatWasNotFittedIsTheAreaOverThatOfTheLargestSmallContact) {
  const PairContact contact;
  const double radius = 6.0, edge = std::numbers::pi * 0.45 * 0.45 * radius * radius;
  EXPECT_DOUBLE_EQ(part_of_range(contact, 1.0, edge, radius), 1.0);
  EXPECT_DOUBLE_EQ(part_of_range(contact, 1.0, 0.5 * edge, radius), 0.5);
  EXPECT_FALSE(is_outside_law(contact, 1.0, 0.999 * edge, radius));
  EXPECT_TRUE(is_outside_law(contact, 1.0, 1.001 * edge, radius));
}

TEST(PartOfRange, OfAFittedLawIsOneAtBothEndsOfTheOverlapsOfTheFit) {
  PairContact contact;
  contact.fitted = {-0.8, 0.35};
  const double radius = 5.0;
  EXPECT_DOUBLE_EQ(part_of_range(contact, 0.35 * radius, 1e9, radius), 1.0);
  EXPECT_DOUBLE_EQ(part_of_range(contact, -0.8 * radius, 1.0, radius), 1.0);
  EXPECT_DOUBLE_EQ(part_of_range(contact, 0.0, 1.0, radius), 0.0);
  EXPECT_NEAR(part_of_range(contact, 0.07 * radius, 1.0, radius), 0.2, 1e-12);
  EXPECT_TRUE(is_outside_law(contact, 0.36 * radius, 1.0, radius));
  EXPECT_TRUE(is_outside_law(contact, -0.81 * radius, 1.0, radius));
}

TEST(PartOfRange, KnowsRangesThatZeroIsNotIn) {
  PairContact contact;
  contact.fitted = {0.1, 0.3};
  EXPECT_NEAR(part_of_range(contact, 0.1, 1.0, 1.0), 1.0, 1e-12);
  EXPECT_NEAR(part_of_range(contact, 0.3, 1.0, 1.0), 1.0, 1e-12);
  EXPECT_NEAR(part_of_range(contact, 0.2, 1.0, 1.0), 0.0, 1e-12);
  EXPECT_TRUE(is_outside_law(contact, 0.05, 1.0, 1.0));
}

}  // namespace
}  // namespace morula::cbm
