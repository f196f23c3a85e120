#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "scenarios/verify/reference_numbers.h"
#include "scenarios/verify/verify.h"

namespace morula::scenarios {
namespace {

/// Largest tolerance that a row may have: what dcm.md allows for its number, else 2 % of the reference, or 1e-5 where the reference is zero. Anything
/// wider needs its line here.
double widest(const ReferenceNumber& number) {
  struct Exception {
    const char* id;
    double relative, absolute;
  };
  static constexpr Exception kExceptions[] = {
      {"T1.4", 0.05, 0.0},             // ± 5 %
      {"T2.2", 0.01, 0.01},            // ± 1 %, Poisson ratio ± 0.01
      {"T3.3", 0.30, 1e-3},            // stationary "up to the discretisation"
      {"T4.1", 0.0, 5.1e-4},           // residuals have one or two digits: 3.1 %, 1.6 %, 0.8 %
      {"T9.5", 0.05, 0.0},             // an order
      {"T10.1", 0.10, 0.0},            // ± 10 %
      {"T10.2", 0.032, 0.0},           // three standard errors
      {"T11.1", 0.05, 0.0},            // ± 5 %
      {"cbm 4", 0.08, 0.0},            // three standard errors of 1000 cells
      {"A 4", 0.04, 0.0},              // an order
      {"D (a)", 0.0, 0.08},            // aim 0.05: a shortfall that is told
      {"D (c)", 0.0, 0.06},            // aim 0.02 R: the same
      {"D (e)", 0.0, 0.06},            // aim 0.03: the same
      {"D (f)", 0.0, 1e-3},            // 0.1 % of the mean way
      {"D (g)", 0.15, 0.0},            // 15 %
      {"S7", 1.0, 0.0},                // some cells and not all
      {"S7.6", 0.06, 0.0},             // 6 %
      {"S7.7", 0.06, 0.0},             // aim 0.04: a shortfall that is told
      {"S16", 1.0, 0.0},               // some cells and not all
      {"S16.1", 0.10, 0.0},            // 10 %
      {"S16.2", 1.0, 1e-9},            // a limit
      {"life founders", 0.16, 0.0},    // three standard errors of 400 cells
      {"life phases", 0.0, 0.01},      // ± 0.01
      {"life size", 0.0, 0.05},        // ± 0.05
      {"life arrest", 0.0, 0.01},      // 1 % of free growth
      {"life division", 0.0, 0.3},     // limits of the overlap and of the energy
      {"life neighbours", 0.0, 0.08},  // limits of a motion
  };
  for (const Exception& e : kExceptions)
    if (number.id == e.id) return e.relative * std::abs(number.reference) + e.absolute;
  return number.reference == 0.0 ? 1e-5 : 0.02 * std::abs(number.reference);
}

class ReferenceNumbers : public testing::TestWithParam<VerifySuite> {};

TEST_P(ReferenceNumbers, AreMet) {
  const auto numbers = GetParam().numbers();
  const auto rows = verify(GetParam());
  ASSERT_EQ(rows.size(), numbers.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].id, numbers[i].id);
    EXPECT_EQ(rows[i].reference, numbers[i].reference);
    EXPECT_TRUE(rows[i].passed) << rows[i].id << ": " << rows[i].quantity << ": " << rows[i].value;
    EXPECT_LE(std::abs(rows[i].value - numbers[i].reference), std::stod(rows[i].tolerance)) << rows[i].id << ": " << rows[i].quantity;
    EXPECT_NEAR(std::stod(rows[i].tolerance), numbers[i].tolerance, 0.1 * numbers[i].tolerance) << rows[i].quantity;  // told as it is
  }
}

TEST(VerifySuites, HaveTolerancesThatNotAnythingPasses) {
  for (const VerifySuite& suite : verify_suites())
    for (const ReferenceNumber& number : suite.numbers()) {
      EXPECT_GT(number.tolerance, 0.0) << number.quantity;
      EXPECT_LE(number.tolerance, widest(number) * (1.0 + 1e-9)) << number.id << ": " << number.quantity;
      EXPECT_LT(number.aim, number.tolerance) << number.quantity;
      EXPECT_FALSE(number.source.empty()) << number.quantity;
    }
}

TEST(VerifySuites, TellWhatIsNotMetYet) {
  for (const VerifySuite& suite : verify_suites()) {
    const auto numbers = suite.numbers();
    const auto rows = rows_of(suite);
    ASSERT_EQ(rows.size(), numbers.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      EXPECT_EQ(rows[i].quantity.find("not met yet") != std::string::npos, numbers[i].aim > 0.0) << rows[i].quantity;
  }
}

/// Those that take minutes are met in verify_hybrid_slow_test.cpp.
std::vector<VerifySuite> quick_suites() {
  std::vector<VerifySuite> out;
  for (const VerifySuite& suite : verify_suites())
    if (!suite.takes_minutes) out.push_back(suite);
  return out;
}

INSTANTIATE_TEST_SUITE_P(Of, ReferenceNumbers, testing::ValuesIn(quick_suites()),
                         [](const auto& suite) { return std::string(suite.param.name); });

/// The numbers of dcm.md that one or two cells show, and those of cbm.md and fields_and_coupling.md that are taken from runs of studies. T7.1 is theory
/// (theory_test); T7.4, T8.1, T8.2 and T9.6 are equilibria and slow pulls, which the studies of single cells have
/// (`morula verify physics --studies`).
TEST(PhysicsNumbers, HaveARowForEachNumberOfThePhysicsPage) {
  std::set<std::string> ids;
  for (const ReferenceNumber& number : physics_numbers()) ids.insert(number.id);
  for (const char* id :
       {"T1.1",  "T1.2",  "T1.3",  "T1.4",  "T2.1",  "T2.2",  "T2.3",    "T2.4",    "T3.1",  "T3.2",  "T3.3",  "T4.1",  "T4.2",
        "T4.3",  "T5.1",  "T5.2",  "T5.3",  "T5.4",  "T5.5",  "T6.1",    "T6.2",    "T6.3",  "T6.4",  "T6.5",  "T6.6",  "T7.2",
        "T7.3",  "T9.1",  "T9.2",  "T9.3",  "T9.4",  "T9.5",  "T10.1",   "T10.2",   "T11.1", "T11.2", "T11.3", "T11.4", "T12.1",
        "T12.2", "T12.3", "T12.4", "T13.1", "T15.2", "T15.3", "cbm 7.1", "cbm 7.2", "cbm 4", "cbm 5", "D",     "A 4",   "A 5"})
    EXPECT_TRUE(ids.contains(id)) << id;
}

}  // namespace
}  // namespace morula::scenarios
