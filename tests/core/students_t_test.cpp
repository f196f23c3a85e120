#include "core/numbers/students_t.h"

#include <gtest/gtest.h>

namespace morula {
namespace {

// Tables of Student 1908 as continued by Fisher & Yates 1938: two-sided 5 %.
TEST(StudentsT, IsThatOfTheTables) {
  EXPECT_NEAR(students_t_95(1.0), 12.706, 5e-4);
  EXPECT_NEAR(students_t_95(2.0), 4.303, 5e-4);
  EXPECT_NEAR(students_t_95(7.0), 2.365, 5e-4);
  EXPECT_NEAR(students_t_95(30.0), 2.042, 5e-4);
  EXPECT_NEAR(students_t_95(1e6), 1.960, 5e-4);
}

}  // namespace
}  // namespace morula
