/// Spheres on obstacles that are curved: studies, and Hertz's overlap read back.
#include <gtest/gtest.h>

#include <cmath>

#include "results/series_reader.h"
#include "tests/cbm/hertz_ellipse.h"
#include "tests/scenarios/snapshots_of_run.h"

namespace morula::scenarios {
namespace {

constexpr double kRadius = 6.0, kForce = 1.0;
constexpr double kModulus = 1.0 / (1.0 - 0.4 * 0.4);  // E* of a cell of 1 kPa on a rigid body [nN/µm²]

/// Hertz: F = (4/3) E* √R* δ^(3/2).
double hertz(double reduced) { return std::pow(0.75 * kForce / (kModulus * std::sqrt(reduced)), 2.0 / 3.0); }

/// How deep a cell that begins at this height goes into an obstacle below it, which it touches without overlap at the height `touching`, under 1 nN [µm], and over which area
/// [µm²].
HertzEllipse contact(const std::string& obstacle, double z, double touching) {
  const auto moments = test::snapshots_of_run(R"(schema: 1
study: curved
time: {end: 40 min, output: 40 min}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  a: {radius: 6 um, cbm: {law: hertz, young: 1 kPa, poisson: 0.4, packing: none}}
geometry:
  p: )" + obstacle + R"(
loads: {w: {type: a, body_force: [0 nN, 0 nN, -1 nN]}}
initial: [{type: a, at: [[0 um, 0 um, )" + std::to_string(z) +
                                              R"( um]]}]
output: {report: false}
)");
  if (moments.size() < 2) return {std::nan(""), std::nan("")};
  const Snapshot::Cell& cell = moments.back().snapshot.cells[0];
  return {touching - cell.centroid.z, cell.contact_area};
}

double overlap(const std::string& obstacle, double z, double touching) { return contact(obstacle, z, touching).overlap; }

TEST(CurvedObstacles, BearSpheresAsHertzSays) {
  EXPECT_NEAR(overlap("{plane: {center: [0 um, 0 um, -20 um], normal: [0, 0, 1], size: 150 um}}", -14.2, -14.0), hertz(kRadius), 2e-3);
  EXPECT_NEAR(overlap("{sphere: {center: [0 um, 0 um, 0 um], radius: 2 um}}", 7.6, 8.0), hertz(1.5), 0.01 * hertz(1.5));
  EXPECT_NEAR(overlap("{sphere: {center: [0 um, 0 um, 0 um], radius: 12 um}}", 17.7, 18.0), hertz(4.0), 0.01 * hertz(4.0));
}

TEST(CurvedObstacles, ThatAreHollowBearSpheresOverMoreOfThem) {
  const double reduced = 1.0 / (1.0 / 6.0 - 1.0 / 20.0);  // 8.6 µm
  EXPECT_NEAR(overlap("{sphere: {center: [0 um, 0 um, 0 um], radius: 20 um}, side: inside}", -13.8, -14.0), hertz(reduced),
              0.01 * hertz(reduced));
  // One that fits the cell acts as one of twice its radius.
  EXPECT_NEAR(overlap("{sphere: {center: [0 um, 0 um, 0 um], radius: 7 um}, side: inside}", -0.8, -1.0), hertz(12.0), 0.01 * hertz(12.0));
}

/// What presses a sphere into a mould, the mould bears along the same line, wherever the nodes and faces are that stand for it.
TEST(CurvedObstacles, ThatAreHollowBearForcesWithoutABend) {
  for (const Vec3d& load : {Vec3d{0.0, 0.0, 0.5}, {0.3, 0.4, 0.0}, {0.1, -0.25, 0.42}, {-0.3, 0.02, -0.4}}) {
    const double force = norm(load);
    const test::Folder folder;
    const auto study = test::read(
        "schema: 1\nstudy: mould\ntime: {end: 4 h, output: 2 h}\ndomain: {size: [200 um, 200 um, 200 um]}\n"
        "cell_types: {a: {adhesion: {others: 0 mN/m}, friction: {obstacle: 1e9 N s/m^3}}}\n"
        "geometry: {w: {sphere: {radius: 20 um}, side: inside}}\ninitial: [{type: a, at: [" +
        test::place_text(load * (13.9 / force)) + "]}]\nloads: {f: {type: a, body_force: " + test::place_text(load, "nN") +
        "}}\noutput: {report: false}\n");
    ASSERT_TRUE(study.ok()) << study.error().text();
    ASSERT_TRUE(test::run_into(folder.path() / "run", *study));
    const auto series = read_series(folder.path() / "run/series.csv");
    ASSERT_TRUE(series.ok());
    const auto told = [&](const std::string& name) { return series->find(name)->values.back(); };
    EXPECT_NEAR(told("force_x_w"), load.x, 0.002 * force);
    EXPECT_NEAR(told("force_y_w"), load.y, 0.002 * force);
    EXPECT_NEAR(told("force_z_w"), load.z, 0.002 * force);
  }
}

TEST(CurvedObstacles, ThatAreRodsBearSpheresOnEllipses) {
  for (const double rod : {6.0, 2.0}) {
    const HertzEllipse expected = hertz_ellipse(1.0 / kRadius + 1.0 / rod, 1.0 / kRadius, kForce, kModulus);
    const std::string text = std::to_string(rod);
    const HertzEllipse found =
        contact("{cylinder: {from: [-40 um, 0 um, 0 um], to: [40 um, 0 um, 0 um], radius: " + text + " um}}", rod + 5.7, rod + 6.0);
    EXPECT_NEAR(found.overlap, expected.overlap, 0.01 * expected.overlap) << rod;
    EXPECT_NEAR(found.area, expected.area, 0.015 * expected.area) << rod;
  }
}

}  // namespace
}  // namespace morula::scenarios
