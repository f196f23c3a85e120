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

}  // namespace
}  // namespace morula::scenarios
