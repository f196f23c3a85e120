/// A periodic box that follows a course, through study files and series.csv (fields_and_coupling.md D (a), E3; decision 0045).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "results/series_reader.h"
#include "scenarios/run/driver.h"
#include "tests/scenarios/close_packing.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr double kRadius = 6.0;  // [µm]
const double kFree = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;

/// Study of cubic cells of a close packing, whose cells have the volume of the free cell at time 0; `rest`: of the study.
std::string packing(const std::array<int, 3>& cells, const std::string& course, const std::string& rest) {
  const double lattice = std::cbrt(4.0 * kFree);
  std::string size;
  for (const int n : cells) size += (size.empty() ? "" : ", ") + std::to_string(n * lattice) + " um";
  return "schema: 1\nstudy: packing\nseed: 1\ndomain: {size: [" + size + "], boundary: periodic, course: [" + course +
         "]}\noutput: {report: false}\n" + rest + ", at: [" + test::close_packed_places({0, 0, 0}, cells, cells, lattice) + "]}\n";
}

std::vector<std::vector<double>> columns_of(const std::string& text, const std::filesystem::path& out,
                                            const std::vector<std::string>& names) {
  const auto study = test::read(text);
  EXPECT_TRUE(study.ok()) << study.error().text();
  RunRequest request;
  request.out = out;
  const auto done = run(*study, request, Comm());
  EXPECT_TRUE(done.ok()) << done.error().message;
  const auto series = read_series(out / "series.csv");
  EXPECT_TRUE(series.ok());
  std::vector<std::vector<double>> columns;
  for (const std::string& name : names) {
    EXPECT_NE(series->find(name), nullptr) << name;
    columns.push_back(series->find(name)->values);
  }
  return columns;
}

/// Force of two equal spheres that adhere, by bisection over the radius of contact a (Johnson, Kendall & Roberts 1971, stable branch):
/// δ = a²/R* − √(2πaW/E*), F = 4E*a³/(3R*) − √(8πWE*a³).
double jkr_force(double overlap, double modulus, double adhesion) {
  const double reduced = 0.5 * kRadius;
  double low = 0.3 * std::sqrt(reduced * overlap), high = kRadius;
  for (int i = 0; i < 200; ++i) {
    const double a = 0.5 * (low + high);
    (a * a / reduced - std::sqrt(2.0 * std::numbers::pi * a * adhesion / modulus) < overlap ? low : high) = a;
  }
  const double a3 = low * low * low;
  return 4.0 * modulus * a3 / (3.0 * reduced) - std::sqrt(8.0 * std::numbers::pi * adhesion * modulus * a3);
}

/// p = 2√2 F/d² of pairs (cbm.md §3, 12 neighbours) and 2√2π(R²/d² − ¼) p_c(φ) of packing, φ = 3s²(3 − s).
double lattice_pressure(double volume_of_cell, double adhesion, double packing_slope, double onset) {
  const double d = std::cbrt(std::numbers::sqrt2 * volume_of_cell), modulus = 1.5 / (2.0 * (1.0 - 0.4 * 0.4));
  const double s = 1.0 - 0.5 * d / kRadius, phi = 3.0 * s * s * (3.0 - s);
  return 2.0 * std::numbers::sqrt2 *
         (jkr_force(2.0 * kRadius - d, modulus, adhesion) / (d * d) +
          std::numbers::pi * (kRadius * kRadius / (d * d) - 0.25) * packing_slope * std::max(0.0, phi - onset));
}

constexpr const char* kSpheres =
    "time: {end: 40 min, output: 4 min}\ncell_types:\n  cell: {radius: 6 um, body: sphere, cbm: {young: 1.5 kPa, poisson: 0.4, ";
const std::string kShrinks = "{time: 0 s, volume: 1}, {time: 40 min, volume: 0.8}";

TEST(ChangingBoxRuns, SpheresOfALatticeHaveThePressureOfTheirPairs) {
  const test::Folder folder;
  const auto got = columns_of(
      packing({3, 3, 3}, kShrinks, kSpheres + std::string("packing: none}, adhesion: {cell: 0 J/m^2}}\ninitial:\n  - {type: cell")),
      folder.path() / "hertz", {"time", "box_volume", "box_pressure", "stress_xx", "stress_yy", "stress_zz", "stress_xy", "total_volume"});
  ASSERT_EQ(got[0].size(), 11u);
  for (std::size_t i = 0; i < got[0].size(); ++i) {
    const double volume = 108.0 * kFree * (1.0 - 0.2 * static_cast<double>(i) / 10.0);
    EXPECT_NEAR(got[1][i], volume, 1e-6 * volume) << i;
    const double p = lattice_pressure(volume / 108.0, 0.0, 0.0, 0.0);
    EXPECT_NEAR(got[2][i], p, 1e-4 * p) << i;
    for (const std::size_t axis : {3u, 4u, 5u}) EXPECT_NEAR(got[axis][i], -p, 1e-4 * p);
    EXPECT_NEAR(got[6][i], 0.0, 1e-6 * p);
    EXPECT_NEAR(got[7][i], 108.0 * kFree, 1e-6 * got[7][i]) << "spheres keep their own volume";
  }
}

}  // namespace
}  // namespace morula::scenarios
