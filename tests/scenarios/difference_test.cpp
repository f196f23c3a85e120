#include "scenarios/compare/difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scenarios/compare/comparison.h"
#include "scenarios/compare/settings.h"

namespace morula::scenarios {
namespace {

// Hours of sleep that two drugs brought to ten patients: Student 1908, doi:10.1093/biomet/6.1.1.
const std::vector<double> kDrug1{0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
const std::vector<double> kDrug2{1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};

/// Welch's test as the manual of R's `t.test` shows it on these: t = 1.8608, 95 % interval of the difference -0.2054832 to 3.3654832.
TEST(Difference, HasTheIntervalOfWelch) {
  const ColumnDifference d = difference_of(kDrug1, kDrug2, 0.75, std::nullopt);
  EXPECT_NEAR(d.reference.mean, 0.75, 1e-12);
  EXPECT_NEAR(d.value.mean, 2.33, 1e-12);
  EXPECT_NEAR(d.difference - d.interval, -0.2054832, 1e-6);
  EXPECT_NEAR(d.difference + d.interval, 3.3654832, 1e-6);
  EXPECT_NEAR(d.in_spreads, 1.8608, 1e-4);
  EXPECT_NEAR(d.relative, 1.58 / 0.75, 1e-12);
  EXPECT_EQ(d.verdict, ComparisonVerdict::kSame);
}

TEST(Difference, OfASingleRunTakesTheSpreadOfTheOthers) {
  // Three values of the deviation 1, one beside: standard error sqrt(1 + 1/3), two degrees of freedom, 4.3027 of them (any table of Student's t).
  const ColumnDifference d = difference_of({1.0, 2.0, 3.0}, {8.0}, 2.0, std::nullopt);
  EXPECT_NEAR(d.interval, 4.3027 * std::sqrt(4.0 / 3.0), 1e-4);
  EXPECT_TRUE(std::isnan(d.value.spread));
  EXPECT_EQ(d.verdict, ComparisonVerdict::kDiffers);
  EXPECT_EQ(difference_of({8.0}, {1.0, 2.0, 3.0}, 8.0, std::nullopt).interval, d.interval);
}

ComparisonVerdict verdict(const std::vector<double>& a, const std::vector<double>& b, std::optional<double> within) {
  return difference_of(a, b, 100.0, within).verdict;
}

TEST(Difference, IsJudgedByWhatIsAskedAndByTheSeeds) {
  const std::vector<double> narrow{99.9, 100.0, 100.1}, wide{80.0, 100.0, 120.0};
  EXPECT_EQ(verdict(narrow, {101.9, 102.0, 102.1}, 0.03), ComparisonVerdict::kWithin);
  EXPECT_EQ(verdict(narrow, {103.9, 104.0, 104.1}, 0.03), ComparisonVerdict::kBeyond);
  EXPECT_EQ(verdict(narrow, {103.9, 104.0, 104.1}, std::nullopt), ComparisonVerdict::kDiffers);
  EXPECT_EQ(verdict(wide, wide, 0.03), ComparisonVerdict::kUndecided) << "seeds spread by more than what is asked";
  EXPECT_EQ(verdict(wide, {300.0, 320.0, 340.0}, 0.03), ComparisonVerdict::kBeyond) << "they spread, and are far apart all the same";
  EXPECT_EQ(verdict(wide, {90.0, 110.0, 130.0}, std::nullopt), ComparisonVerdict::kSame);
  EXPECT_EQ(verdict({100.0}, {102.0}, 0.03), ComparisonVerdict::kWithin);
  EXPECT_EQ(verdict({100.0}, {104.0}, 0.03), ComparisonVerdict::kBeyond);
  EXPECT_EQ(verdict({100.0}, {104.0}, std::nullopt), ComparisonVerdict::kUnknown);
  EXPECT_EQ(verdict({5.0, 5.0}, {5.0, 5.0}, std::nullopt), ComparisonVerdict::kSame);
  EXPECT_EQ(verdict({5.0, 5.0}, {6.0, 6.0}, std::nullopt), ComparisonVerdict::kDiffers);
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdict({100.0}, {none}, 0.03), ComparisonVerdict::kBeyond) << "nothing to judge is no pass";
  EXPECT_EQ(verdict({100.0}, {none}, std::nullopt), ComparisonVerdict::kUnknown);
}

TEST(Difference, FromNothingHasNoRelativeSize) {
  EXPECT_TRUE(std::isnan(difference_of({0.0}, {1.0}, 0.0, std::nullopt).relative));
  EXPECT_EQ(difference_of({0.0}, {0.0}, 0.0, 0.03).verdict, ComparisonVerdict::kWithin);
  EXPECT_EQ(difference_of({0.0}, {1.0}, 0.0, 0.03).verdict, ComparisonVerdict::kBeyond);
}

TEST(StudySettings, AreComparedPathByPath) {
  const auto a = settings_of("a: 1\nb: {c: 2 um, d: [x, y]}\nseed: 1\n", "a"),
             b = settings_of("a: 1\nb: {c: 3 um, d: [x, y, z]}\nseed: 2\n", "b");
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_EQ(setting(*a, "b.d.1"), "y");
  EXPECT_EQ(differing_paths({&*a, &*b}, {"seed"}), (std::vector<std::string>{"b.c", "b.d.2"}));
  EXPECT_EQ(differing_paths({&*a, &*b}, {}), (std::vector<std::string>{"b.c", "b.d.2", "seed"}));
  EXPECT_FALSE(settings_of("a: [1\n", "damaged").ok());
}

}  // namespace
}  // namespace morula::scenarios
