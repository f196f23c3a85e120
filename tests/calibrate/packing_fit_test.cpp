#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/close_packing.h"
#include "scenarios/calibrate/confidence.h"
#include "scenarios/calibrate/packing_geometry.h"
#include "scenarios/calibrate/table_fit.h"
#include "tests/calibrate/synthetic.h"

namespace morula::calibrate {
namespace {

/// Rows of the table of cbm.md §3: R = 6 µm, E = 0.45 kPa, ν = 0.4, W = 0, K_V = 2.5 kPa.
struct Row {
  double volume_ratio, packing, hertz, total, packed;  // V/V0, φ, p_H, p_t, p_c [Pa]
};
constexpr Row kTable[] = {{0.98450, 0.08700, 19.72, 39.06, 37.13},   {0.95204, 0.10491, 23.26, 122.86, 170.83},
                          {0.92031, 0.12442, 27.11, 207.61, 278.91}, {0.85898, 0.16817, 35.77, 380.03, 440.16},
                          {0.80043, 0.21811, 45.81, 556.51, 551.00}, {0.69144, 0.33600, 70.59, 922.44, 681.72},
                          {0.56973, 0.51562, 112.24, 1406.5, 749.07}};

TEST(Lattice, FaceCentredIsTheTableOfIdealFilledCells) {
  const PairModel hertz = jkr_model(0.45, 0.4, 0.0);
  for (const Row& row : kTable) {
    const PackingGeometry at = lattice_geometry(Arrangement::kFaceCentred, row.volume_ratio);
    EXPECT_NEAR(at.packing, row.packing, 2e-5);
    EXPECT_NEAR(1e3 * pair_pressure(at, 6.0, hertz), row.hertz, 1e-2);
    EXPECT_NEAR(row.hertz + at.press * row.packed, row.total, 4e-2);  // five digits of V/V0 are 1e-5 K_V
    EXPECT_EQ(at.neighbours.size(), 1u);
  }
}

// cbm.md §3: spheres of a body-centred lattice have their own volume each at d = (π√3)^{1/3} R = 1.7588825 R.
TEST(Lattice, BodyCentredHasEightNeighboursAndThenFourteen) {
  const PackingGeometry confluent = lattice_geometry(Arrangement::kBodyCentred, 1.0);
  EXPECT_NEAR(confluent.neighbours[0].distance, 1.7588825, 1e-7);
  EXPECT_EQ(confluent.neighbours.size(), 1u);
  const PackingGeometry pressed = lattice_geometry(Arrangement::kBodyCentred, 0.9);
  ASSERT_EQ(pressed.neighbours.size(), 2u);
  EXPECT_EQ(pressed.neighbours[1].count, 6.0);
  EXPECT_NEAR(pressed.neighbours[1].distance / pressed.neighbours[0].distance, 2.0 / std::numbers::sqrt3, 1e-12);
}

// Spheres at the places of a lattice are that lattice: three cubes of a face-centred packing along each axis, told by their places.
TEST(Lattice, IsWhatItsPlacesSay) {
  const PackingGeometry lattice = lattice_geometry(Arrangement::kFaceCentred, 0.9);
  const double edge = std::cbrt(4.0 * lattice.room) * kRadius, box = 3.0 * edge;
  std::vector<Vec3d> places;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z)
        for (const Vec3d& p : {Vec3d{0, 0, 0}, Vec3d{0.5, 0.5, 0}, Vec3d{0.5, 0, 0.5}, Vec3d{0, 0.5, 0.5}})
          places.push_back((Vec3d{1.0 * x, 1.0 * y, 1.0 * z} + p) * edge + Vec3d{box, 0, -box} * (x % 2));  // images of it
  const PackingGeometry told = geometry_of_places(places, box, kRadius);
  EXPECT_NEAR(told.room, lattice.room, 1e-12);
  EXPECT_NEAR(told.packing, lattice.packing, 1e-12);
  EXPECT_NEAR(told.press, lattice.press, 1e-12);
  const PairModel pair = jkr_model(kYoung, kPoisson, kAdhesion);
  EXPECT_NEAR(pair_pressure(told, kRadius, pair), pair_pressure(lattice, kRadius, pair), 1e-12);
}

// The pressure is minus the change of energy with volume: dU = −p dV, pairs and packing alike.
TEST(Lattice, PressureIsMinusTheChangeOfEnergyWithVolume) {
  const auto law = cbm::make_pair_law(cbm::ContactMaterial::elastic(0.45, 0.4, 0.45, 0.4, 0.05), 6.0, 6.0);
  const PairModel pair = jkr_model(0.45, 0.4, 0.05);
  const double ball = 4.0 / 3.0 * std::numbers::pi * 216.0;
  for (const Arrangement lattice : {Arrangement::kFaceCentred, Arrangement::kBodyCentred}) {
    for (const double ratio : {1.05, 0.9, 0.8}) {
      const auto energy = [&](double v) {  // of one cell; Ψ = φ²/2, so that the packing pressure is φ [kPa]
        const PackingGeometry at = lattice_geometry(lattice, v);
        double sum = ball * 0.5 * at.packing * at.packing;
        for (const Neighbours& shell : at.neighbours) sum += 0.5 * shell.count * cbm::jkr_contact(law, (2.0 - shell.distance) * 6.0).energy;
        return sum;
      };
      const double h = 1e-5;
      const PackingGeometry at = lattice_geometry(lattice, ratio);
      const double expected = -(energy(ratio + h) - energy(ratio - h)) / (2.0 * h * ball);
      EXPECT_NEAR(pair_pressure(at, 6.0, pair) + at.press * at.packing, expected, 1e-7 * (1.0 + std::abs(expected))) << ratio;
    }
  }
}

/// p_c of ideal filled cells [kPa] at any φ = 3s²(3 − s) (cbm.md §3).
double ideal_pressure(double packing) {
  const double modulus = 0.45 / (2.0 * (1.0 - 0.16));
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 80; ++k) {
    const double s = 0.5 * (low + high);
    (3.0 * s * s * (3.0 - s) < packing ? low : high) = s;
  }
  const double s = low, ratio = std::pow((1.0 - s) / (1.0 - 0.09530010471822248), 3.0);
  const double hertz = 4.0 * std::numbers::sqrt2 / 3.0 * modulus * std::pow(s, 1.5) / ((1.0 - s) * (1.0 - s));
  const double half = 0.5 / (1.0 - s);
  return std::max(0.0, (2.5 * std::log(1.0 / ratio) - hertz) / (2.0 * std::numbers::sqrt2 * std::numbers::pi * (half * half - 0.25)));
}

/// Packings from V/V0 1.1 in steps of 0.02, of JKR spheres whose packing pressure is that of ideal filled cells, beside pairs of them.
Data packed(double last) {
  Data out = jkr_points(-0.5, 1.5, 21, 0.0, 1);
  const PairModel pair = jkr_model(kYoung, kPoisson, kAdhesion);
  for (const Arrangement lattice : {Arrangement::kFaceCentred, Arrangement::kBodyCentred})
    for (double ratio = 1.1; ratio > last - 0.01; ratio -= 0.02) {
      const PackingGeometry at = lattice_geometry(lattice, ratio);
      const double pressure = pair_pressure(at, kRadius, pair) + at.press * ideal_pressure(at.packing);
      out.packings.push_back({100 + static_cast<int>(lattice), lattice, ratio, pressure, kRadius, false});
    }
  return out;
}

double worst_error(const Fit& fit, double last) {
  const auto curve = cbm::PackingCurve::through(fit.parameters.knots);
  double worst = 0.0;
  for (double packing = 0.08; packing < last; packing += 1e-3) {
    const double truth = ideal_pressure(packing);
    if (truth > 0.03) worst = std::max(worst, std::abs(curve->at(packing).pressure / truth - 1.0));
  }
  return worst;
}

// fields_and_coupling.md, E: eight knots within 2 % where p_c > 30 Pa; interpolation alone costs 1.2 %.
TEST(PackingFit, FindsTheCurveBetweenEightKnotsOfTheTable) {
  FitOptions options{.poisson = kPoisson, .packing = {0.0829053}};  // φ_on of the table
  for (const Row& row : kTable) options.packing.push_back(row.packing);
  const auto fitted = fit(packed(0.57), options);
  ASSERT_TRUE(fitted.ok()) << fitted.error().message;
  EXPECT_LT(worst_error(*fitted, 0.51562), 0.02);
  EXPECT_NEAR(fitted->parameters.young / kYoung, 1.0, 1e-3);
  EXPECT_NEAR(fitted->parameters.adhesion / kAdhesion, 1.0, 1e-3);
}

TEST(PackingFit, PlacesKnotsByItself) {
  const auto fitted = fit(packed(0.7), {.poisson = kPoisson});
  ASSERT_TRUE(fitted.ok()) << fitted.error().message;
  ASSERT_EQ(fitted->parameters.knots.size(), 8u);
  EXPECT_LT(worst_error(*fitted, 0.33), 0.02);
}

TEST(PackingFit, OfPairsAloneHasNoCurve) {
  Data data = packed(0.7);
  const PairModel pair = jkr_model(kYoung, kPoisson, kAdhesion);
  for (PackingPoint& point : data.packings) point.pressure = pair_pressure(point.geometry(), point.radius, pair);
  const auto fitted = fit(data, {.poisson = kPoisson});
  ASSERT_TRUE(fitted.ok());
  EXPECT_TRUE(fitted->parameters.knots.size() < 3 || fitted->parameters.knots.back().pressure < 1e-3);
}

/// Regular clusters of cells at this distance: a triangle, a tetrahedron, one and its twelve neighbours.
std::vector<Vec3d> cluster_of(int cells, double distance) {
  if (cells == 13) return close_packed_places(1, distance);
  const std::vector<Vec3d> corners{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}};
  std::vector<Vec3d> out;
  for (int k = 0; k < cells; ++k) out.push_back(corners[static_cast<std::size_t>(k)] * (distance / std::numbers::sqrt2));
  return out;
}

// cbm.md §3: two equal spheres that overlap by 2 s R have φ = ¼ s² (3 − s); and the force is the slope of the energy, here with p_c = φ, Ψ = ½ φ².
TEST(Cluster, OfTwoIsWhatCapsSay) {
  const std::vector<cbm::PackingKnot> knots{{1e-3, 0.0}, {0.1, 0.099}, {0.2, 0.199}, {0.5, 0.499}};
  const auto curve = cbm::PackingCurve::through(knots);
  ASSERT_TRUE(curve.ok());
  const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 3.0);
  const auto packing = [](double overlap) {
    const double s = overlap / (2.0 * kRadius);
    return 0.25 * s * s * (3.0 - s) * 4.0 / 2.0 / 2.0;
  };
  for (const double overlap : {1.5, 2.0, 3.0}) {
    EXPECT_NEAR(packing_of_pair(overlap / kRadius), packing(overlap), 1e-12);
    const PackingGeometry at = geometry_of_cluster(std::vector<Vec3d>{{0, 0, 0}, {0, 0, 2.0 * kRadius - overlap}}, kRadius);
    EXPECT_NEAR(at.packing, packing(overlap), 1e-12);
    const auto energy = [&](double x) { return ball * (curve->at(packing(x)).pressure > 0.0 ? std::pow(packing(x) - 1e-3, 2.0) : 0.0); };
    const double h = 1e-4;
    EXPECT_NEAR(packing_force_of_pair(*curve, kRadius, kRadius, overlap), (energy(overlap + h) - energy(overlap - h)) / (2.0 * h), 2e-3)
        << overlap;
  }
  EXPECT_EQ(packing_force_of_pair(*curve, kRadius, kRadius, -0.1), 0.0);
  EXPECT_EQ(packing_force_of_pair({}, kRadius, kRadius, 1.0), 0.0);
}

// Balls whose packing sets in at φ = 3 %, softly: packings of which only those beyond 8 % are known, and the distances at which clusters of the same balls rest. Without the clusters nobody
// can tell what is between.
TEST(PackingFit, ClustersTellHowTheCurveBegins) {
  const auto truth = [](double packing) { return 0.5 * std::pow(std::max(0.0, packing - 0.03), 1.5) * 10.0; };  // [kPa]
  const PairModel pair = jkr_model(0.3, kPoisson, kAdhesion);
  Data data;
  for (double overlap = -0.4; overlap < 1.5; overlap += 0.1)
    data.pairs.push_back(
        {.experiment = 1, .overlap = overlap, .force = pair(overlap, 0.5 * kRadius).force, .radius_a = kRadius, .radius_b = kRadius});
  for (double ratio = 0.98; ratio > 0.69; ratio -= 0.02) {
    const PackingGeometry at = lattice_geometry(Arrangement::kFaceCentred, ratio);
    const double pressure = pair_pressure(at, kRadius, pair) + at.press * truth(at.packing);
    data.packings.push_back({2, Arrangement::kFaceCentred, ratio, pressure, kRadius, false});
  }
  const FitOptions options{.poisson = kPoisson};
  const auto curve_of = [&](const Data& from) { return cbm::PackingCurve::through(fit_curve(from, pair, options)); };
  const auto without = curve_of(data);
  ASSERT_TRUE(without.ok());
  const auto at_rest = [&](int cells) {  // the distance at which pairs and packing are in balance
    double low = 1.2 * kRadius, high = 2.0 * kRadius;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      const PackingGeometry at = geometry_of_cluster(cluster_of(cells, middle), kRadius);
      double packed = 0.0;
      for (const PackedPart& part : at.parts) packed += part.press * truth(part.packing);
      (pair_pressure(at, kRadius, pair) + packed > 0.0 ? low : high) = middle;
    }
    return low;
  };
  for (const int cells : {3, 4, 13})
    data.clusters.push_back(
        {.experiment = cells, .places = geometry_of_cluster(cluster_of(cells, at_rest(cells)), kRadius), .radius = kRadius});
  const auto with = curve_of(data);
  ASSERT_TRUE(with.ok());
  const double told = data.clusters[1].places.packing;  // of the tetrahedron
  ASSERT_GT(told, 0.04);
  ASSERT_LT(told, 0.08);
  EXPECT_NEAR(with->at(told).pressure / truth(told), 1.0, 0.1);
  EXPECT_GT(std::abs(without->at(told).pressure / truth(told) - 1.0), 0.3);
  for (const double packing : {0.12, 0.2, 0.3}) EXPECT_NEAR(with->at(packing).pressure / truth(packing), 1.0, 0.05) << packing;
  data.clusters.push_back({.experiment = 5, .places = geometry_of_cluster(cluster_of(3, 2.01 * kRadius), kRadius), .radius = kRadius});
  const auto apart = curve_of(data);
  ASSERT_TRUE(apart.ok());
  EXPECT_EQ(apart->at(told).pressure, with->at(told).pressure) << "cells that do not touch tell nothing";
}

// Experiments of pairs alone and of packings alone are drawn from in full: a sample without any pair would tell nothing.
TEST(Bootstrap, OfManyExperimentsIsAsWideAsTheProfile) {
  Data data = jkr_points(-0.5, 1.5, 161, 1.0, 11);
  const auto best = fit(data, {.poisson = kPoisson, .weights = {.force_relative = 0.0}});
  ASSERT_TRUE(best.ok());
  const Bootstrap drawn = bootstrap(data, *best, 400, 5);
  ASSERT_TRUE(drawn.possible);
  EXPECT_EQ(drawn.logarithms.size(), 400u);
  // The noise of 161 points is known to 1/√322 = 6 %, the width of 400 samples to 5 %.
  const Covariance errors = covariance(data, *best);
  EXPECT_NEAR(std::log(drawn.young.high / drawn.young.low) / (2 * 1.96), errors.young_error, 0.2 * errors.young_error);
  EXPECT_NEAR(std::log(drawn.adhesion.high / drawn.adhesion.low) / (2 * 1.96), errors.adhesion_error, 0.2 * errors.adhesion_error);
  EXPECT_EQ(bootstrap(data, *best, 20, 5).logarithms, bootstrap(data, *best, 20, 5).logarithms);
  for (PairPoint& point : data.pairs) point.experiment = 1;
  EXPECT_FALSE(bootstrap(data, *best, 20, 5).possible);
}

}  // namespace
}  // namespace morula::calibrate
