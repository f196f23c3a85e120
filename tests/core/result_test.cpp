#include "core/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace morula {
namespace {

enum class Fault { kSingular, kTooLong };

Result<int> half(int n) {
  if (n % 2 != 0) return Error{ErrorKind::kInput, std::to_string(n) + " is odd", "give an even number"};
  return n / 2;
}
Status must_be_even(int n) {
  MORULA_TRY(half(n));
  return {};
}
Result<std::string> quarter(int n, int& evaluations) {
  MORULA_TRY_ASSIGN(const int once, half((++evaluations, n)));
  MORULA_TRY_ASSIGN(auto twice, half(once));
  return std::to_string(twice);
}
Result<std::unique_ptr<int>> boxed(int n) {
  MORULA_TRY_ASSIGN(auto value, half(n));
  return std::make_unique<int>(value);
}
Result<int> unboxed(int n) {
  MORULA_TRY_ASSIGN(std::unique_ptr<int> box, boxed(n));
  return *box;
}

TEST(Result, HoldsAValueOrAnError) {
  const auto good = half(8);
  ASSERT_TRUE(good.ok());
  EXPECT_TRUE(static_cast<bool>(good));
  EXPECT_EQ(*good, 4);
  const auto bad = half(7);
  ASSERT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().kind, ErrorKind::kInput);
  EXPECT_EQ(bad.error().message, "7 is odd");
  EXPECT_EQ(bad.error().help, "give an even number");
}

TEST(Result, TryPassesTheErrorOn) {
  EXPECT_TRUE(must_be_even(2).ok());
  EXPECT_EQ(must_be_even(3).error().message, "3 is odd");
}

TEST(Result, TryAssignDeclaresTheValueAndEvaluatesOnce) {
  int evaluations = 0;
  EXPECT_EQ(*quarter(12, evaluations), "3");
  EXPECT_EQ(evaluations, 1);
  EXPECT_EQ(quarter(6, evaluations).error().message, "3 is odd");
  EXPECT_EQ(quarter(5, evaluations).error().message, "5 is odd");
}

TEST(Result, CarriesTypesThatOnlyMove) {
  EXPECT_EQ(*unboxed(10), 5);
  EXPECT_FALSE(unboxed(9).ok());
  auto box = boxed(4);
  const std::unique_ptr<int> taken = std::move(box).value();
  EXPECT_EQ(*taken, 2);
}

TEST(Result, ErrorsMayBeAnyType) {
  const Result<double, Fault> fault = Fault::kTooLong;
  EXPECT_EQ(fault.error(), Fault::kTooLong);
  const Result<void, Fault> none;
  EXPECT_TRUE(none.ok());
  const Result<void, Fault> some = Fault::kSingular;
  EXPECT_EQ(some.error(), Fault::kSingular);
}

}  // namespace
}  // namespace morula
