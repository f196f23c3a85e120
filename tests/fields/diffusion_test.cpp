#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/fields/helpers.h"

namespace morula::fields::test {
namespace {

constexpr double kPi = std::numbers::pi;

double sine_mode(const Vec3d& x, double side) {
  return std::sin(kPi * x.x / side) * std::sin(kPi * x.y / side) * std::sin(kPi * x.z / side);
}

/// Decay rate of the lowest mode of a cube with 0 on its faces, measured over one interval.
double measured_decay_rate(int cells_per_side, double interval, double tolerance) {
  const Space space = cube(200.0);
  FieldSpec spec = spec_of(2000.0, 200.0 / cells_per_side);
  hold_all_faces(spec, 0.0);
  spec.relative_tolerance = tolerance;
  Field field = field_of(spec, space, [](Vec3d x) { return sine_mode(x, 200.0); });
  const double before = value_at(field, cells_per_side / 2, cells_per_side / 2, cells_per_side / 2);
  advance(field, spec, space, interval);
  const double after = value_at(field, cells_per_side / 2, cells_per_side / 2, cells_per_side / 2);
  return std::log(before / after) / interval;
}

// Exact rate 3π²D/L²; the eigenvalues of cell-centred finite volumes with the value on the face are known in closed form.
constexpr double kExactRate = 1.4804406601634036;

TEST(Diffusion, DecaysAtTheRateOfTheDiscreteLaplacian) {
  // The discrete eigenvalue is (4/h²) sin²(πh/2L) per axis: relative errors −1.2785 %, −0.32086 %, −0.080293 % for 8, 16, 32 voxels.
  // The rest is the integrator's tolerance.
  EXPECT_NEAR(measured_decay_rate(8, 0.4, 1e-8) / kExactRate - 1.0, -1.2785e-2, 1e-6);
  EXPECT_NEAR(measured_decay_rate(16, 0.4, 1e-8) / kExactRate - 1.0, -3.2086e-3, 1e-6);
  EXPECT_NEAR(measured_decay_rate(32, 0.02, 1e-8) / kExactRate - 1.0, -8.0293e-4, 2e-6);
}

/// Sides that are no multiple of one width: each axis has voxels, and an eigenvalue (4D/h²) sin²(πh/2L), of its own.
TEST(Diffusion, AlongEachAxisHasTheVoxelsOfThatAxis) {
  Space space = cube(1.0);
  const Vec3d side{104.0, 44.0, 76.0};
  space.box.high = side;
  FieldSpec spec = spec_of(2000.0, 10.0);
  hold_all_faces(spec, 0.0);
  spec.relative_tolerance = 1e-8;
  Field field = field_of(
      spec, space, [&](Vec3d x) { return std::sin(kPi * x.x / side.x) * std::sin(kPi * x.y / side.y) * std::sin(kPi * x.z / side.z); });
  const Vec3d h = field.grid.spacing();
  ASSERT_GT(std::abs(h.x - h.y), 0.3);
  ASSERT_GT(std::abs(h.y - h.z), 0.3);
  double rate = 0.0;
  for (std::size_t a = 0; a < 3; ++a) rate += 4.0 * 2000.0 / (h[a] * h[a]) * std::pow(std::sin(0.5 * kPi * h[a] / side[a]), 2);
  const double before = value_at(field, 5, 2, 3);
  advance(field, spec, space, 0.05);
  EXPECT_NEAR(std::log(before / value_at(field, 5, 2, 3)) / (0.05 * rate), 1.0, 1e-6);
}

TEST(Diffusion, IsOfSecondOrderInSpace) {
  const double coarse = std::fabs(measured_decay_rate(8, 0.4, 1e-8) - kExactRate);
  const double fine = std::fabs(measured_decay_rate(16, 0.4, 1e-8) - kExactRate);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
}

TEST(Diffusion, ErrorFollowsTheTolerance) {
  // Against the exact discrete decay; both methods: a short interval is explicit, a long one implicit.
  const double h = 200.0 / 8;
  const double discrete = 3.0 * 2000.0 * 4.0 / (h * h) * std::pow(std::sin(kPi * h / 400.0), 2);
  for (const double interval : {0.2, 3.0}) {
    const auto error = [&](double tolerance) { return std::fabs(measured_decay_rate(8, interval, tolerance) - discrete) * interval; };
    const double loose = error(1e-3), middle = error(1e-5), tight = error(1e-7);
    EXPECT_LT(loose, 5e-3);
    EXPECT_LT(middle, 0.5 * loose);
    EXPECT_LT(tight, 0.1 * middle);
  }
}

TEST(Diffusion, ChoosesTheCheaperMethodAndSaysWhich) {
  const Space space = cube(200.0);
  FieldSpec spec = spec_of(2000.0, 10.0, 1.0);
  hold_all_faces(spec, 0.0);
  Field field = field_of(spec, space);
  EXPECT_EQ(advance(field, spec, space, 0.05).work.method, Method::kExplicit);
  EXPECT_EQ(advance(field, spec, space, 60.0).work.method, Method::kImplicit);
}

TEST(Diffusion, FillsACubeAsTheSeriesSays) {
  // Cube of 60 µm, D = 2000 µm²/min, 1 on the faces, 0 at the start; centre = 1 − [Σ (4/π)(−1)ⁿ/(2n+1) e^{−D((2n+1)π/L)² t}]³
  // (closed form, separation of variables; Carslaw & Jaeger 1959, 3.3). An odd number of voxels puts one at the centre.
  const Space space = cube(60.0);
  FieldSpec spec = spec_of(2000.0 / 60.0, 4.0);
  hold_all_faces(spec, 1.0);
  spec.relative_tolerance = 1e-5;
  Field field = field_of(spec, space);
  double time = 0.0;
  for (const auto& [minutes, centre] : {std::pair{0.05, 0.189894}, {0.1, 0.606514}, {0.2, 0.923106}, {0.4, 0.997135}, {1.0, 1.0}}) {
    const auto report = advance(field, spec, space, 60.0 * minutes - time);
    time = 60.0 * minutes;
    EXPECT_NEAR(value_at(field, 7, 7, 7), centre, 0.01) << minutes << " min";
    EXPECT_LT(report.balance_error(), 1e-12);
  }
}

TEST(Diffusion, PointReleaseSpreadsAsAGaussian) {
  // c = N (4πDt)^{−3/2} e^{−r²/4Dt}; N = 10⁶ amol, D = 2000: at t = 0.5 s 0.70988043 at r = 0 and 0.64232638, 0.37997161, 0.05827053 mM
  // at 20, 50, 100 µm. Started from the exact field at 0.1 s; h = 10 gives 2 % (second order).
  const double amount = 1e6, diffusion = 2000.0;
  const auto exact = [&](double r2, double t) {
    return amount * std::pow(4.0 * kPi * diffusion * t, -1.5) * std::exp(-r2 / (4.0 * diffusion * t));
  };
  EXPECT_NEAR(exact(0.0, 0.5), 0.70988043, 1e-8);
  EXPECT_NEAR(exact(1e4, 0.5), 0.05827053, 1e-8);
  Space space = cube(410.0);
  FieldSpec spec = spec_of(diffusion, 10.0);
  const Vec3d middle{205, 205, 205};
  Field field = field_of(spec, space, [&](Vec3d x) { return exact(norm2(x - middle), 0.1); });
  const double before = total_amount(field, alone());
  advance(field, spec, space, 0.4);
  EXPECT_NEAR(value_at(field, 20, 20, 20), 0.70988043, 0.02 * 0.70988043);
  EXPECT_NEAR(value_at(field, 22, 20, 20), 0.64232638, 0.02 * 0.64232638);
  EXPECT_NEAR(value_at(field, 20, 25, 20), 0.37997161, 0.02 * 0.37997161);
  EXPECT_NEAR(value_at(field, 20, 20, 30), 0.05827053, 0.02 * 0.05827053);
  EXPECT_NEAR(total_amount(field, alone()) / before, 1.0, 1e-12);
}

TEST(Diffusion, APeriodicModeDecaysAndKeepsItsMean) {
  // c̄ + ½ cos(2πx/L) cos(2πy/L) cos(2πz/L), discrete rate 3·D (4/h²) sin²(πh/L); 12 voxels: two bricks, the second one thin.
  const double side = 120.0, h = 10.0, diffusion = 500.0, interval = 1.0;
  const Space space = cube(side, BoundaryKind::kPeriodic);
  FieldSpec spec = spec_of(diffusion, h);
  spec.relative_tolerance = 1e-7;
  hold_all_faces(spec, 7.0);  // must be ignored on periodic axes
  const auto wave = [&](Vec3d x) {
    return std::cos(2 * kPi * x.x / side) * std::cos(2 * kPi * x.y / side) * std::cos(2 * kPi * x.z / side);
  };
  Field field = field_of(spec, space, [&](Vec3d x) { return 1.0 + 0.5 * wave(x); });
  const double before = total_amount(field, alone());
  advance(field, spec, space, interval);
  const double factor = std::exp(-interval * 3.0 * diffusion * 4.0 / (h * h) * std::pow(std::sin(kPi * h / side), 2));
  for (const auto& v : {std::array{0, 0, 0}, {3, 7, 11}, {8, 8, 8}, {11, 0, 5}})
    EXPECT_NEAR(value_at(field, v[0], v[1], v[2]), 1.0 + 0.5 * factor * wave(field.grid.voxel_center({v[0], v[1], v[2]})), 1e-6);
  EXPECT_NEAR(total_amount(field, alone()) / before, 1.0, 1e-13);
}

TEST(Diffusion, MeetsAnExponentialBoundaryLayerWithDecay) {
  // 0 = D c″ − λ c, c = 1 at x = 0 and no flux at x = L: c = cosh((L − x)√(λ/D))/cosh(L√(λ/D)).
  // Second order: h = 2.5 µm against the length √(D/λ) = 50 µm gives errors below 10⁻³. Decayed = came in, at steady state.
  Space space;
  space.box = {{0, 0, 0}, {100, 20, 20}};
  FieldSpec spec = spec_of(50.0, 2.5);
  spec.reactions = {decay_of(0.02)};
  spec.boundary[0][0] = {FaceCondition::Kind::kValue, 1.0};
  spec.relative_tolerance = 1e-6;
  Field field = field_of(spec, space);
  advance(field, spec, space, 1000.0);
  const auto steady = advance(field, spec, space, 100.0);
  for (const int i : {0, 10, 20, 39}) {
    const double x = (i + 0.5) * 2.5;
    EXPECT_NEAR(value_at(field, i, 3, 5), std::cosh((100.0 - x) / 50.0) / std::cosh(2.0), 1e-3);
  }
  EXPECT_NEAR(steady.inflow[0][0] / steady.decayed, 1.0, 1e-4);
  EXPECT_EQ(steady.inflow[0][1], 0.0);
  EXPECT_LT(steady.balance_error(), 1e-12);
}

TEST(Diffusion, StaysWithinItsBoundsInASharpStep) {
  // A step 0/1 and a long implicit step: undershoot is reported, never clipped, and stays within the tolerance.
  const Space space = cube(160.0);
  FieldSpec spec = spec_of(2000.0, 10.0);
  spec.relative_tolerance = 1e-4;
  Field field = field_of(spec, space, [](Vec3d x) { return x.x < 80.0 ? 1.0 : 0.0; });
  double low = 0.0;
  for (int i = 0; i < 5; ++i) {
    const auto report = advance(field, spec, space, 10.0);
    low = std::min(low, report.minimum);
    EXPECT_LE(report.maximum, 1.0 + 1e-3);
  }
  EXPECT_GE(low, -1e-3);
  EXPECT_NEAR(value_at(field, 0, 0, 0), 0.5, 1e-2);
}

TEST(Diffusion, DecayAloneIsExponential) {
  const Space space = cube(40.0);
  FieldSpec spec = spec_of(0.0, 10.0, 2.0);
  spec.reactions = {decay_of(0.1)};
  spec.relative_tolerance = 1e-8;
  Field field = field_of(spec, space);
  const auto report = advance(field, spec, space, 10.0);
  EXPECT_NEAR(value_at(field, 1, 2, 3), 2.0 * std::exp(-1.0), 1e-6);
  EXPECT_NEAR(report.decayed, 64000.0 * 2.0 * (1.0 - std::exp(-1.0)), 64000.0 * 1e-6);
}

}  // namespace
}  // namespace morula::fields::test
