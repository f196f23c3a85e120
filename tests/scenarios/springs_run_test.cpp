// Two spheres that overlap push each other apart by the springs that a study names: γ dδ/dt = −2 F(δ).
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/scenarios/own_parts.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;

/// γ of a sphere of 6 µm in a medium of 1 nN·s/µm³ [nN·s/µm].
constexpr double kFriction = 4.0 * std::numbers::pi * 36.0;

std::string two_balls(const std::string& law) {
  return R"(schema: 1
study: springs
time: {end: 5 min, step: 0.5 s, output: 1 min, checkpoint: 5 min}
numerics: {tolerance: 1e-6}
domain: {size: [100 um, 100 um, 100 um]}
cell_types: {ball: {radius: 6 um, friction: {medium: 1e9 N s/m^3, cell_cell: 0 N s/m^3}, cbm: {law: )" +
         law + R"(}}}
initial: [{type: ball, at: [[5 um, 0 um, 0 um], [-5 um, 0 um, 0 um]]}]
output: {report: false}
)";
}

class Springs : public OwnParts {
 protected:
  Springs() : OwnParts([](Laws&) {}) {}

  /// Against overlaps [µm] by time [s] that are known. Implicit steps of 0.5 s change it too little by ½ rate² Δt t: 0.04 % at
  /// the end of the linear one.
  void expect_overlaps(const std::string& law, const std::string& name, const std::function<double(double)>& expected) {
    run_whole(two_balls(law), name);
    const auto time = column(name, "time"), extent = column(name, "largest_extent");
    ASSERT_EQ(time.size(), 6u);
    EXPECT_NEAR(extent[0], 11.0, 1e-12);
    for (std::size_t i = 0; i < time.size(); ++i) {
      const double overlap = 24.0 - 2.0 * extent[i];  // the far side of a ball is at (12 − δ)/2 + 6
      EXPECT_NEAR(overlap, expected(time[i]), 1e-3 * expected(time[i])) << law << " at " << time[i];
    }
    EXPECT_LT(expected(time.back()), 1.6) << "they have come apart";
  }
};

TEST_F(Springs, RelaxAsTheirClosedForms) {
  expect_overlaps("linear, spring_stiffness: 0.5 nN/um", "linear", [](double t) { return 2.0 * std::exp(-2.0 * 0.5 / kFriction * t); });
  expect_overlaps("quadratic, spring_stiffness: 0.5 nN/um, spring_length: 2 um", "quadratic",
                  [](double t) { return 2.0 / (1.0 + 2.0 * 0.5 * 2.0 / (2.0 * kFriction) * t); });
  // Without a closed form: Runge and Kutta's steps of a second.
  expect_overlaps("logarithmic, spring_stiffness: 1 nN/um, spring_length: 0.5 um", "logarithmic", [](double t) {
    const auto rate = [](double x) { return -2.0 * 0.5 * std::log(1.0 + x / 0.5) / kFriction; };
    double x = 2.0;
    for (int k = 0; k < static_cast<int>(t + 0.5); ++k) {
      const double a = rate(x), b = rate(x + 0.5 * a), c = rate(x + 0.5 * b), d = rate(x + c);
      x += (a + 2.0 * b + 2.0 * c + d) / 6.0;
    }
    return x;
  });
  EXPECT_THAT(file("logarithmic", "methods.md"), HasSubstr("F = k l ln(1 + δ/l)"));
}

TEST_F(Springs, AreCheckedAndExplained) {
  const auto errors = [&](const std::string& law) {
    const auto found = read(two_balls(law));
    return found.ok() ? std::string() : found.error().text();
  };
  EXPECT_THAT(errors("linear, spring_length: 2 um"), HasSubstr("'spring_length' has no effect here [E515]"));
  EXPECT_THAT(errors("linear, spring_length: 2 um"), HasSubstr("it belongs to `law: quadratic` or `law: logarithmic`"));
  EXPECT_THAT(errors("jkr, spring_stiffness: 2 nN/um"), HasSubstr("[E515]"));
  EXPECT_THAT(errors("linear, spring_stiffness: 0 nN/um"), HasSubstr("[E302]"));
  EXPECT_THAT(explain("spring_length"), HasSubstr("default:  1 um"));
}

}  // namespace
}  // namespace morula::scenarios::test
