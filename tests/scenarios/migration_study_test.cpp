// Speed of cells that crawl on a plate, through study files with default parameters.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "coupling/behaviours/migration.h"
#include "results/snapshot_file.h"
#include "scenarios/run/driver.h"
#include "tests/results/results_support.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr double kSpeed = 20.0 / 3600.0;  // S [µm/s]

/// Cells far from each other that adhere to a plate and crawl on it at 20 µm/h.
std::string walkers(const std::string& walk, const std::string& body, int along, const std::string& time) {
  constexpr int kApart = 80;  // [µm]
  std::string places;
  for (int i = 0; i < along * along; ++i) {
    const auto at = [&](int k) { return std::to_string(kApart * k - kApart * (along - 1) / 2) + " um, "; };
    places += (i > 0 ? ", [" : "[") + at(i % along) + at(i / along) + "5.9 um]";
  }
  const std::string size = std::to_string(kApart * (along + 2)) + " um";
  std::string text = R"(schema: 1
study: walkers
seed: 3
time: {TIME}
domain: {size: [SIZE, SIZE, 100 um]}
cell_types:
  cell:
    adhesion: {cell: 0 J/m^2, plate: 5e-5 J/m^2}
    migration: {speed: 20 um/hWALK}
geometry:
  plate: {box: {center: [0 um, 0 um, -5 um], size: [SIZE, SIZE, 10 um]}}
initial:
  - {type: cell, at: [PLACES], as: BODY}
output: {report: false}
)";
  for (int k = 0; k < 2; ++k) text = test::changed("[SIZE, SIZE", "[" + size + ", " + size, text);
  return test::changed("TIME", time, test::changed("WALK", walk, test::changed("PLACES", places, test::changed("BODY", body, text))));
}

class Walkers : public ::testing::Test {
 protected:
  /// Centroids by output, then by cell.
  std::vector<std::vector<Vec3d>> run_study(const std::string& text) {
    auto study = test::read(text, {}, folder_.path());
    EXPECT_TRUE(study.ok()) << study.error().text();
    if (!study.ok()) return {};
    types_ = study->model.types;
    RunRequest request;
    request.out = folder_.path() / "run";
    request.command = "a test";
    const auto done = run(*study, request, Comm());
    EXPECT_TRUE(done.ok()) << done.error().message;
    std::vector<std::vector<Vec3d>> out;
    const std::size_t count = list_snapshots(folder_.path() / "run/results.h5")->size();
    for (std::size_t k = 0; k < count; ++k) {
      const Snapshot snapshot = read_snapshot(folder_.path() / "run/results.h5", k).value();
      ids_.clear();
      out.emplace_back();
      for (const Snapshot::Cell& cell : snapshot.cells) ids_.push_back(cell.id), out.back().push_back(cell.centroid);
    }
    return out;
  }

  test::Folder folder_;
  std::vector<CellType> types_;
  std::vector<CellId> ids_;
};

/// 324 cells for 3 h: some 2000 independent moments, whose root mean square is good to 1.2 %. Over 3 min of the 30 min that a direction lasts,
/// ⟨d²⟩ = S² t² · 2 (τ − 1 + e^(−τ))/τ², τ = t/P.
TEST_F(Walkers, SpheresOnAPlateHaveTheSpeedOfTheStudy) {
  for (const char* walk : {"", ", substrate: plate"}) {
    const auto places = run_study(walkers(walk, "sphere", 18, "end: 3 h, output: 3 min"));
    ASSERT_EQ(places.size(), 61u);
    double square = 0.0;
    std::size_t count = 0;
    for (std::size_t k = 4; k < places.size(); ++k)  // after they have sat down
      for (std::size_t i = 0; i < places[k].size(); ++i, ++count) {
        const Vec3d d = places[k][i] - places[k - 1][i];
        square += d.x * d.x + d.y * d.y;
      }
    const double tau = 0.1, lost = 2.0 * (tau - 1.0 + std::exp(-tau)) / (tau * tau);
    const double speed = 3600.0 * std::sqrt(square / (lost * static_cast<double>(count))) / 180.0;
    RecordProperty(std::string("speed_um_per_h") + (*walk != 0 ? "_on_substrate" : ""), std::to_string(speed));
    EXPECT_NEAR(speed, 20.0, 1.0) << "um/h, walk" << walk;
    for (const Vec3d& place : places.back()) EXPECT_NEAR(place.z, 5.9, 1.0) << "all are still on the plate";
    std::filesystem::remove_all(folder_.path() / "run");
  }
}

/// Nine shells that keep their direction: together they have the speed of the study within the 5 % of the mark, and each goes where it wants to, √(3/2)
/// of what it wants in the plane. The rim of a contact goes over faces of 1.8 µm, which shifts single cells by up to 0.5 µm in 20 min, 0.08 of the speed.
TEST_F(Walkers, ShellsOnAPlateHaveTheSpeedOfTheStudy) {
  const auto places = run_study(walkers(", substrate: plate, persistence: 1e5 h", "shell", 3, "end: 40 min, output: 10 min"));
  ASSERT_EQ(places.size(), 5u);
  double square = 0.0, wanted_square = 0.0;
  for (std::size_t i = 0; i < 9; ++i) {
    const Vec3d wanted = initial_migration_velocity(ids_[i], types_[0], 3) * std::sqrt(1.5);
    const Vec3d v = (places[4][i] - places[2][i]) * (1.0 / 1200.0);
    EXPECT_NEAR(v.x, wanted.x, 0.08 * kSpeed) << i;
    EXPECT_NEAR(v.y, wanted.y, 0.08 * kSpeed) << i;
    square += v.x * v.x + v.y * v.y;
    wanted_square += wanted.x * wanted.x + wanted.y * wanted.y;
  }
  const double speed = 20.0 * std::sqrt(square / wanted_square);
  RecordProperty("speed_um_per_h", std::to_string(speed));
  EXPECT_NEAR(speed, 20.0, 1.0) << "um/h";
}

/// 900 spheres on a lattice that nothing touches, S = 20 µm/h: in the plane x = 0, 28 µm apart, or in space, 80 µm.
std::string free_walkers(const std::string& migration, const std::string& rest, bool in_plane, const std::string& time) {
  const int along = in_plane ? 30 : 10, apart = in_plane ? 28 : 80;
  std::string places;
  for (int i = 0; i < 900; ++i) {
    const auto at = [&](int k) { return std::to_string(apart * k - apart * (along - 1) / 2) + " um"; };
    const std::string x = in_plane ? "0 um" : at(i / (along * along));
    places += (i > 0 ? ", [" : "[") + x + ", " + at(i % along) + ", " + at(i / along % along) + "]";
  }
  return "schema: 1\nstudy: free\nseed: 5\ntime: {" + time +
         "}\ndomain: {size: [840 um, 840 um, 840 um]}\ncell_types:\n  cell: {radius: 6 um, adhesion: {cell: 0 J/m^2}, migration: {speed: "
         "20 um/h, " +
         migration + "}}\ncontact: {range: 1 um}\ninitial:\n  - {type: cell, at: [" + places + "]}\n" + rest + "output: {report: false}\n";
}

/// Runs of 20 min on average, read every 10 min, in steps of 30 s. A cell that has not tumbled after the first step has gone straight, S t; no cell has gone
/// further. The part of these is e^(−(t − dt)/τ); the mean square displacement is 2S²τ [t − τ (1 − e^(−t/τ))]. Four standard errors of 900 cells; at long
/// times those of the sum of three squares, √(2/3/900).
TEST_F(Walkers, RunAndTumbleRunsStraightForExponentialTimes) {
  const auto places = run_study(free_walkers("law: run_and_tumble, run_time: 20 min", "", false, "end: 3 h, step: 30 s, output: 10 min"));
  ASSERT_EQ(places.size(), 19u);
  const double way = kSpeed * 600.0;
  std::size_t straight = 0, windows = 0;
  for (std::size_t k = 1; k < places.size(); ++k)
    for (std::size_t i = 0; i < places[k].size(); ++i, ++windows) {
      const double gone = norm(places[k][i] - places[k - 1][i]);
      ASSERT_LT(gone, 1.002 * way) << k << ", " << i;
      straight += gone > 0.998 * way;
    }
  const double part = static_cast<double>(straight) / static_cast<double>(windows), expected = std::exp(-570.0 / 1200.0);
  EXPECT_NEAR(part, expected, 4.0 * std::sqrt(expected * (1.0 - expected) / static_cast<double>(windows)) + 0.002)
      << "0.002: runs nearly as long";
  for (const std::size_t k : {2u, 6u, 18u}) {
    double square = 0.0;
    for (std::size_t i = 0; i < places[k].size(); ++i) square += norm2(places[k][i] - places[0][i]) / static_cast<double>(places[k].size());
    const double t = 600.0 * static_cast<double>(k), tau = 1200.0;
    EXPECT_NEAR(square / (2.0 * kSpeed * kSpeed * tau * (t - tau * (1.0 - std::exp(-t / tau)))), 1.0, 4.0 * std::sqrt(2.0 / 3.0 / 900.0))
        << t;
  }
}

/// A field that rises from 0.2 to 1 mM over 840 µm: 12 µm · 0.8/840 mM/µm over 0.6 mM is 1.905 % across a cell. With half of the response at 2 % cells drift
/// with b = 0.8/(1 + 2/1.905) = 0.3902 of their speed; with receptors of K = 0.6 mM the signal is a quarter of that, 0.476 %, and b = 0.1538.
/// Their velocities have S²(1 − b²)/3 across. Four standard errors of 900 cells, and 2 % of the drift, for the field is higher where they come to.
TEST_F(Walkers, ChemotaxisDriftsByTheGradientOfAFieldAndKeepsItsSpeed) {
  const std::string field =
      "fields: {bait: {diffusion: 1e-9 m^2/s, initial: 0.6 mM, voxel: 42 um, boundary: {x_low: 0.2 mM, x_high: 1 mM}}}\n";
  for (const auto& [receptors, b] : {std::pair{"", 0.3902}, std::pair{", dissociation: 0.6 mM", 0.1538}}) {
    const auto places =
        run_study(free_walkers(std::string("law: chemotaxis, field: bait, persistence: 5 min, half_response: 2 %") + receptors, field, true,
                               "end: 3 h, output: 30 min"));
    ASSERT_EQ(places.size(), 7u);
    Vec3d drift{};
    double across = 0.0;
    for (std::size_t i = 0; i < places[6].size(); ++i) {  // from 1 h on: the field takes some minutes
      const Vec3d d = places[6][i] - places[2][i];
      drift += d * (1.0 / 900.0);
      across += (d.y * d.y + d.z * d.z) / (2.0 * 900.0);
    }
    const double t = 7200.0, persistence = 300.0, variance = kSpeed * kSpeed * (1.0 - b * b) / 3.0;
    const double spread = 2.0 * variance * persistence * (t - persistence);
    EXPECT_NEAR(drift.x, kSpeed * b * t, 4.0 * std::sqrt(spread / 900.0) + 0.02 * kSpeed * b * t) << receptors;
    EXPECT_NEAR(drift.y, 0.0, 4.0 * std::sqrt(spread / 900.0));
    EXPECT_NEAR(drift.z, 0.0, 4.0 * std::sqrt(spread / 900.0));
    EXPECT_NEAR(across / spread, 1.0, 4.0 * std::sqrt(2.0 / 1800.0) + 0.01);
    std::filesystem::remove_all(folder_.path() / "run");
  }
}

/// Where the response is whole nothing is left to chance: b = 1, and all go up the gradient with S once they have forgotten how they began.
TEST_F(Walkers, ChemotaxisWithAWholeResponseGoesStraight) {
  const std::string field =
      "fields: {bait: {diffusion: 1e-9 m^2/s, initial: 0.6 mM, voxel: 42 um, boundary: {x_low: 0.2 mM, x_high: 1 mM}}}\n";
  const auto places = run_study(free_walkers("law: chemotaxis, field: bait, persistence: 5 min, half_response: 0, index: 100 %", field,
                                             true, "end: 3 h, output: 30 min"));
  ASSERT_EQ(places.size(), 7u);
  for (std::size_t i = 0; i < places[6].size(); ++i)
    EXPECT_NEAR((places[6][i] - places[4][i]).x, kSpeed * 3600.0, 0.01 * kSpeed * 3600.0) << i;
}

}  // namespace
}  // namespace morula::scenarios
