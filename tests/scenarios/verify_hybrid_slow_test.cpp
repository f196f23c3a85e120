// `morula verify hybrid`: what spheres and shells share, by studies that are run.
#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/verify/verify.h"

namespace morula::scenarios {
namespace {

TEST(VerifyHybrid, RowsAreMetAndWhatIsToldAsNotMetIsNot) {
  const VerifySuite* suite = find_suite("hybrid");
  ASSERT_NE(suite, nullptr);
  const auto numbers = suite->numbers();
  const auto rows = verify(*suite);
  ASSERT_EQ(rows.size(), numbers.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_TRUE(rows[i].passed) << rows[i].id << ": " << rows[i].quantity << ": " << rows[i].value;
    if (numbers[i].aim > 0.0) {
      EXPECT_GT(std::abs(rows[i].value - numbers[i].reference), numbers[i].aim) << rows[i].quantity;
    }
  }
}

}  // namespace
}  // namespace morula::scenarios
