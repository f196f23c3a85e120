/// What obstacles that move, and springs to places of the laboratory, do to cells with default numerics: studies, results read back.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "results/series_reader.h"
#include "tests/scenarios/snapshots_of_run.h"

namespace morula::scenarios {
namespace {

constexpr double kDrag = 0.1 * 4.0 * std::numbers::pi * 36.0;  // of a cell of 6 µm with the usual 1e8 N s/m³ [nN·s/µm]

std::string study(const std::string& type, const std::string& geometry, const std::string& at, const std::string& more = "") {
  return R"(schema: 1
study: moved
time: {end: 30 min, output: 10 min}
domain: {size: [200 um, 200 um, 100 um]}
cell_types:
  a: {radius: 6 um, )" +
         type + R"(}
geometry:
  p: )" + geometry +
         "\ninitial: [{type: a, at: [" + at + "]}]\n" + more + "output: {report: false}\n";
}

/// The last values of a column of the series.
double last_of(const std::string& text, const std::string& column) {
  const test::Folder folder;
  const auto read = test::read(text);
  EXPECT_TRUE(read.ok()) << read.error().text();
  if (!read.ok() || !test::run_into(folder.path() / "run", *read)) return std::nan("");
  const auto series = read_series(folder.path() / "run/series.csv");
  EXPECT_TRUE(series.ok() && series->find(column) != nullptr) << column;
  return series.ok() && series->find(column) ? series->find(column)->values.back() : std::nan("");
}

double way_of(const std::string& text) {
  const auto moments = test::snapshots_of_run(text);
  EXPECT_EQ(moments.size(), 4u);
  return moments.size() < 4 ? std::nan("") : moments[3].snapshot.cells[0].centroid.x - moments[0].snapshot.cells[0].centroid.x;
}

const std::string kFloor =
    "{plane: {center: [0 um, 0 um, -20 um], normal: [0, 0, 1], size: 180 um}, motion: {velocity: [60 um/h, 0 um/h, 0 um/h]}}";
const std::string kPlate =
    "{plane: {center: [-50 um, 0 um, 0 um], normal: [1, 0, 0], size: 90 um}, motion: {velocity: [60 um/h, 0 um/h, 0 um/h]}}";
const std::string kWeight = "loads: {w: {type: a, body_force: [0 nN, 0 nN, -2 nN]}}\n";

TEST(MovingObstacles, TakeSpheresAlongThatTheyRub) {
  // v/V = γ_o A/(γ_o A + γ_med 4πR²) with γ_o = 50 nN·s/µm³ and the area of contact of some 30 µm²: 1500 against 45 nN·s/µm.
  const double way = way_of(study("adhesion: {others: 1e-5 J/m^2}", kFloor, "[0 um, 0 um, -14.2 um]", kWeight));
  EXPECT_GT(way, 0.95 * 30.0);
  EXPECT_LT(way, 30.0);
}

TEST(MovingObstacles, TakeShellsAlongThatTheyRub) {
  const double way = way_of(study("body: shell, adhesion: {others: 1e-5 J/m^2}", kFloor, "[0 um, 0 um, -14 um]", kWeight));
  EXPECT_GT(way, 0.7 * 30.0);  // it rolls
  EXPECT_LT(way, 30.0);
}

TEST(MovingObstacles, PushSpheresWithTheirDrag) {
  const std::string text = study("adhesion: {others: 0 J/m^2}, friction: {obstacle: 0 N s/m^3}", kPlate, "[-43.9 um, 0 um, 0 um]");
  EXPECT_NEAR(-last_of(text, "force_x_p"), kDrag * 60.0 / 3600.0, 0.1 * kDrag * 60.0 / 3600.0) << "newton_stop leaves a part of the force";
}

TEST(MovingObstacles, PushSpheresThatTheyRubAndStayBehindThem) {
  // What rubs bears a part of the force while the sphere comes up to speed; before, it stood against the plate as if that were at rest.
  const std::string text = study("adhesion: {others: 0 J/m^2}", kPlate, "[-43.9 um, 0 um, 0 um]");
  EXPECT_NEAR(-last_of(text, "force_x_p"), kDrag * 60.0 / 3600.0, 0.15 * kDrag * 60.0 / 3600.0);
}

TEST(MovingObstacles, PushShellsThatStayRound) {
  const std::string text = test::changed("velocity: [60 um/h,", "velocity: [6 um/h,",
                                         study("body: shell, adhesion: {others: 0 J/m^2}", kPlate, "[-43.9 um, 0 um, 0 um]"));
  const auto moments = test::snapshots_of_run(test::changed("end: 30 min, output: 10 min", "end: 4 h, output: 1 h", text));
  ASSERT_EQ(moments.size(), 5u);
  const double round = moments.front().snapshot.cells[0].area;
  for (const auto& moment : moments) EXPECT_NEAR(moment.snapshot.cells[0].area, round, 0.002 * round) << moment.time;  // was 1.3 % more
  EXPECT_NEAR(-last_of(text, "force_x_p"), kDrag * 6.0 / 3600.0, 0.3)
      << "nN; a tight solver has the drag within 0.002, and 3.5 were told before";
}

TEST(Traps, BearTheLoadWhateverIsFarAway) {
  const std::string text = R"(schema: 1
study: trapped
time: {end: 10 min, output: 5 min}
domain: {size: [400 um, 200 um, 200 um]}
cell_types:
  held: {radius: 6 um}
  pushed: {radius: 6 um}
loads:
  trap: {type: held, trap: {stiffness: 1 mN/m, center: [-98 um, -60 um, 0 um]}}
  weight: {type: held, body_force: [0 nN, 0.5 nN, 0 nN]}
  wind: {type: pushed, body_force: [1 nN, 0 nN, 0 nN]}
initial:
  - {type: held, at: [[-98 um, -60 um, 0 um]], as: shell}
  - {type: pushed, at: [[-100 um, 60 um, 0 um], [-100 um, 80 um, 0 um], [-100 um, 40 um, 0 um]], as: shell}
output: {report: false}
)";
  EXPECT_NEAR(last_of(text, "grip_y_trap"), -0.5, 0.002);  // was 4 % off
  EXPECT_NEAR(last_of(text, "grip_x_trap"), 0.0, 0.002);
}

}  // namespace
}  // namespace morula::scenarios
