#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/verify/reference_numbers.h"
#include "scenarios/verify/verify.h"

namespace morula::scenarios {
namespace {

TEST(ReferenceNumbers, AreMet) {
  const auto numbers = physics_numbers();
  EXPECT_GE(numbers.size(), 30u);
  for (const ReferenceNumber& number : numbers) {
    EXPECT_NEAR(number.compute(), number.reference, number.tolerance) << number.id << ": " << number.quantity;
    EXPECT_GT(number.tolerance, 0.0) << number.quantity;
    EXPECT_LE(number.tolerance, 0.02 * std::abs(number.reference) + 1e-12) << number.quantity << ": a tolerance that anything passes";
    EXPECT_FALSE(number.source.empty());
  }
}

TEST(ReferenceNumbers, AreTheRowsOfTheVerification) {
  const auto numbers = physics_numbers();
  const auto rows = verify_physics();
  ASSERT_EQ(rows.size(), numbers.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].id, numbers[i].id);
    EXPECT_EQ(rows[i].reference, numbers[i].reference);
    EXPECT_TRUE(rows[i].passed) << rows[i].quantity;
  }
}

}  // namespace
}  // namespace morula::scenarios
