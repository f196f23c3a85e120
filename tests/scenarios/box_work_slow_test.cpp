/// The stress of the box is what the tissue's work says, with adhesion and without (decision 0054): −dE/dV of the energy told by a run, which knows nothing
/// of stresses, against the pressure told at the volume between. A study with default contacts and numerics; series.csv read back.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "results/series_reader.h"
#include "scenarios/run/driver.h"
#include "tests/scenarios/close_packing.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

/// 32 shells in a periodic box: it rests for 20 h at V/V0 0.94, then for 6 h at 0.93 and at 0.92. Edges creep into corners for hours.
std::string packing(const std::string& adhesion) {
  const std::array<int, 3> cells{2, 2, 2};
  const double lattice = std::cbrt(4.0 * 0.94 * 4.0 / 3.0 * std::numbers::pi * 216.0);
  const std::string side = std::to_string(2.0 * lattice) + " um";
  const auto at = [](const char* time, double ratio) {
    return "{time: " + std::string(time) + ", volume: " + std::to_string(ratio / 0.94) + "}";
  };
  return "schema: 1\nstudy: box_work\nseed: 1\ntime: {end: 32 h, output: 1 h}\ndomain: {size: [" + side + ", " + side + ", " + side +
         "], boundary: periodic, course: [{time: 0 s, volume: 1}, {time: 20 h, volume: 1}, " + at("1220 min", 0.93) + ", " +
         at("26 h", 0.93) + ", " + at("1570 min", 0.92) + "]}\ncell_types:\n  cell:\n    radius: 6 um\n    adhesion: {cell: " + adhesion +
         "}\n    dcm: {cortex: {elastic: none, tension: 0.2 mN/m}}\ninitial:\n"
         "  - {type: cell, start_volume: 60 %, inflate: 20 min, as: shell, at: [" +
         test::close_packed_places({0, 0, 0}, cells, cells, lattice) + "]}\noutput: {report: false}\n";
}

class BoxWork : public testing::TestWithParam<const char*> {};

TEST_P(BoxWork, IsThePressureOfTheBox) {
  const test::Folder folder;
  const auto study = test::read(packing(GetParam()));
  ASSERT_TRUE(study.ok()) << study.error().text();
  RunRequest request;
  request.out = folder.path() / "run";
  const auto done = run(*study, request, Comm());
  ASSERT_TRUE(done.ok()) << done.error().message;
  const auto series = read_series(request.out / "series.csv");
  ASSERT_TRUE(series.ok());
  const auto value = [&](const char* name, std::size_t hour) { return series->find(name)->values.at(hour); };
  const double work = -(value("energy", 32) - value("energy", 20)) / (value("box_volume", 32) - value("box_volume", 20));
  EXPECT_GT(work, 0.15);
  // Left after these holds: 0.3 % of creep, and the triangles' shape, which has no energy of its own to keep, 0.3 %.
  EXPECT_NEAR(value("box_pressure", 26) / work, 1.0, 0.01);
}

// Adhesion of a quarter of the tension of two surfaces: told as pressure of the cells, −W A/(3V) would be 21 Pa of 192.
INSTANTIATE_TEST_SUITE_P(Adhesion, BoxWork, testing::Values("0 J/m^2", "1e-4 J/m^2"),
                         [](const auto& param) { return param.index == 0 ? std::string("None") : std::string("AQuarterOfTwoTensions"); });

}  // namespace
}  // namespace morula::scenarios
