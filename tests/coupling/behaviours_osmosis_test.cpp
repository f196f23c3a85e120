// Osmosis: reference numbers T6.1–T6.6 of the physics pages and section B of the fields' page.
#include "coupling/behaviours/osmosis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/behaviours/division.h"
#include "coupling/cell_record.h"
#include "coupling/simulation.h"
#include "coupling/swaps.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

using namespace test;

constexpr double kVolume = 904.778684233860;  // R = 6
constexpr double kArea = 4.0 * std::numbers::pi * 36.0;

OsmoticCell cell_at_300(double inactive = 0.3, double permeability = 1e-3) {
  return {permeability, 300.0 * (1.0 - inactive) * kVolume, inactive * kVolume, 300.0, 0.0, kArea};
}

CellType osmotic_type(double outside = 300.0, double inactive = 0.3) {
  CellType type;
  type.osmosis.permeability = 1e-3;
  type.osmosis.outside = outside;
  type.osmosis.inactive = inactive;
  return type;
}

CellState row_of(double target = kVolume) {
  CellState row;
  row.id = CellId::founder(1);
  row.birth_volume = row.target_volume = target;
  row.division_volume = 2.0 * target;
  return row;
}

TEST(Osmosis, HasThePressureOfVantHoff) { EXPECT_NEAR(kGasEnergy * 300.0, 773.62, 0.005); }

TEST(Osmosis, HoldsTheSolutesOfItsTargetVolume) {
  EXPECT_NEAR(osmotic_cell(row_of(), osmotic_type(), 0.0, kArea, 0.0).osmolytes, 190003.5, 0.1);
  EXPECT_NEAR(osmotic_cell(row_of(), osmotic_type(300.0, 0.0), 0.0, kArea, 0.0).osmolytes, 271433.6, 0.1);
}

TEST(Osmosis, RelaxesInItsTime) {
  EXPECT_NEAR(osmotic_time(cell_at_300(), kVolume), 1.810, 5e-4);
  EXPECT_NEAR(osmotic_time(cell_at_300(0.0), kVolume), 2.585, 1e-3);
}

TEST(Osmosis, RestsAtTheVolumeOfBoyleAndVantHoff) {
  const std::pair<double, double> expected[] = {{150.0, 1.7}, {450.0, 0.766667}, {600.0, 0.65}};
  for (const auto& [outside, part] : expected) {
    OsmoticCell cell = cell_at_300();
    cell.outside = outside;
    EXPECT_NEAR(osmotic_volume(cell) / kVolume, part, 1e-6);
    EXPECT_NEAR(volume_after_flux(cell, kVolume, 3600.0) / kVolume, part, 1e-6);
  }
}

TEST(Osmosis, FollowsAShockInTime) {
  OsmoticCell cell = cell_at_300();
  cell.outside = 150.0;
  const std::pair<double, double> expected[] = {{1, 1.16055}, {2, 1.27567}, {5, 1.48143}, {10, 1.62206}, {20, 1.68934}, {60, 1.70000}};
  for (const auto& [time, part] : expected)
    EXPECT_NEAR(volume_after_flux(cell, kVolume, time) / kVolume, part, 2e-5) << "at " << time << " s";
}

/// At a fixed area the equation of section B; its area goes with V^{2/3} here, so the reference is integrated with that by a fine explicit step.
TEST(Osmosis, IsSecondOrderAndSplitsIntoSteps) {
  OsmoticCell cell = cell_at_300(0.4, 1e-4);
  cell.outside = 450.0;
  double volume = kVolume;
  const double step = 1e-3;
  const auto flux = [&](double v) {
    const double area = kArea * std::pow(v / kVolume, 2.0 / 3.0);
    return cell.permeability * area * kGasEnergy * (cell.osmolytes / (v - cell.inactive) - cell.outside);
  };
  for (int k = 0; k < 10000; ++k) volume += step * flux(volume + 0.5 * step * flux(volume));
  EXPECT_NEAR(volume_after_flux(cell, kVolume, 10.0), volume, 2e-5 * kVolume);
  double split = kVolume;
  for (int k = 0; k < 10; ++k) {
    OsmoticCell now = cell;
    now.area = kArea * std::pow(split / kVolume, 2.0 / 3.0);
    split = volume_after_flux(now, split, 1.0);
  }
  EXPECT_NEAR(split, volume, 2e-5 * kVolume);
}

TEST(Osmosis, NeverOvershootsWhateverTheStep) {
  OsmoticCell cell = cell_at_300();
  for (const double outside : {40.0, 150.0, 600.0, 4000.0})
    for (const double dt : {0.01, 1.0, 100.0, 1e5}) {
      cell.outside = outside;
      const double after = volume_after_flux(cell, kVolume, dt), rest = osmotic_volume(cell);
      EXPECT_GE((after - kVolume) * (rest - kVolume), 0.0);
      EXPECT_LE(std::abs(after - kVolume), std::abs(rest - kVolume) * (1.0 + 1e-9)) << outside << " mM, " << dt << " s";
    }
}

TEST(Osmosis, TakesTheMediumFromACourseAndAField) {
  CellType type = osmotic_type(300.0);
  type.osmosis.course = {{0.0, 10.0}, {1.0, 0.5}};
  type.osmosis.field = 1;
  CellState row = row_of();
  row.variables = {0.0, 0.0, 0.0, 20.0};
  EXPECT_DOUBLE_EQ(osmotic_cell(row, type, 0.0, kArea, 0.0).outside, 320.0);
  EXPECT_DOUBLE_EQ(osmotic_cell(row, type, 5.0, kArea, 0.0).outside, 245.0);
  EXPECT_DOUBLE_EQ(osmotic_cell(row, type, 50.0, kArea, 0.0).outside, 170.0);
}

TEST(Osmosis, SolutesAreKeptOverASwapAndSharedByDaughters) {
  const CellType type = osmotic_type(150.0);
  CellState row = row_of();
  row.reference_excess = std::log(1.7);
  const double before = osmotic_cell(row, type, 0.0, kArea, 0.0).osmolytes;
  const double radius = std::cbrt(3.0 * 1.7 * kVolume / (4.0 * std::numbers::pi));
  CellRecord cell{row, SphereRecord{{0, 0, 0}, radius, {}, {}}, std::nullopt};
  ShapeLibrary shapes;
  promote(cell, type, 0.0, 0.0, shapes, 1);
  EXPECT_EQ(osmotic_cell(cell.row, type, 0.0, kArea, 0.0).osmolytes, before);
  demote(cell, type, 1.0);
  EXPECT_EQ(osmotic_cell(cell.row, type, 0.0, kArea, 0.0).osmolytes, before);
  EXPECT_NEAR(cell.sphere->radius, radius, 1e-9);
  EXPECT_NEAR(cell.row.reference_excess, std::log(1.7), 1e-9) << "a swollen sphere stays swollen";

  const auto pair = divide_row(cell.row, {}, type, 1, 10.0, 0.0, 0.4);
  const double first = osmotic_cell(pair.first, type, 0.0, kArea, 0.0).osmolytes,
               second = osmotic_cell(pair.second, type, 0.0, kArea, 0.0).osmolytes;
  EXPECT_NEAR(first + second, before, 1e-9 * before);
  EXPECT_NEAR(first / before, 0.4, 1e-12);
  EXPECT_EQ(pair.first.reference_excess, cell.row.reference_excess);
}

struct End {
  double volume, reference;  ///< V/V_t, V0/V_t
  double imbalance;          ///< V over the volume at which no water flows under the body's own pressure, less 1
};

/// A free cell of tension 0.5 run to `time` with steps of at most max_step.
End run(BodyKind body, double outside, double time, double max_step, const char* what) {
  Model model = clusters_model(0.0);
  model.types[0].osmosis = osmotic_type(outside).osmosis;
  model.types[0].shell.spring_stiffness = 0.0;
  model.types[0].shell.hinge_stiffness = 0.0;
  model.step.max_step = max_step;
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(model, shapes, {{0, 0, 0}}, {body});
  auto simulation = std::move(Simulation::create(model, std::move(tissue), Comm(), 1)).value();
  while (simulation->tissue().clock.time < time) {
    const auto step = simulation->step(time);
    EXPECT_TRUE(step.ok()) << what;
    if (!step.ok()) break;
  }
  const double reference = body == BodyKind::kShell ? simulation->tissue().shells.reference_volume[0] : 0.0;
  const BodyValues now = simulation->values();
  const OsmoticCell cell = osmotic_cell(simulation->tissue().cells.state(0), model.types[0], simulation->tissue().clock.time, now.area[0],
                                        now.inner_pressure[0]);
  return {now.volume[0] / kVolume, reference / kVolume, now.volume[0] / osmotic_volume(cell) - 1.0};
}

TEST(OsmosisOfAShell, ShiftsTheVolumeByNoMoreThanItsTensionAsks) {
  const End end = run(BodyKind::kShell, 300.0, 600.0, 60.0, "isotonic");
  EXPECT_NEAR(end.volume, 0.99985, 3e-5);
  EXPECT_NEAR(end.imbalance, 0.0, 1e-6);
  EXPECT_NEAR(end.reference, 1.0688, 2e-3) << "V exp(2γ/(R K_V)); the mesh of 162 nodes has 1.4 % more pressure";
}

TEST(OsmosisOfAShell, SwellsInHalfTheMediumWhateverTheStep) {
  for (const double step : {2.0, 60.0}) {
    const End end = run(BodyKind::kShell, 150.0, 600.0, step, "swelling");
    EXPECT_NEAR(end.volume, 1.6995, 3e-4) << step;
    EXPECT_NEAR(end.imbalance, 0.0, 1e-6) << step;
  }
}

TEST(OsmosisOfAShell, FollowsTheShockInTime) {
  EXPECT_NEAR(run(BodyKind::kShell, 150.0, 2.0, 0.1, "early").volume, 1.27567, 0.02) << "the cortex stretches against the medium";
  EXPECT_NEAR(run(BodyKind::kShell, 150.0, 10.0, 0.1, "late").volume, 1.62206, 0.01);
}

TEST(OsmosisOfASphere, SwellsLikeAShell) {
  EXPECT_NEAR(run(BodyKind::kSphere, 150.0, 600.0, 60.0, "swelling").volume, 1.7, 1e-3);
  EXPECT_NEAR(run(BodyKind::kSphere, 600.0, 600.0, 60.0, "shrinking").volume, 0.65, 1e-3);
}

TEST(OsmosisOfAShell, GrowsWithItsSolutes) {
  Model model = clusters_model(0.0);
  CellType& type = model.types[0];
  type.osmosis = osmotic_type(300.0).osmosis;
  type.cycles = true;
  type.cycle_duration = {3600.0, 0.0};
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  tissue.cells.rows[0].cycle_duration = 3600.0;
  auto simulation = std::move(Simulation::create(model, std::move(tissue), Comm(), 1)).value();
  while (simulation->tissue().clock.time < 1800.0) ASSERT_TRUE(simulation->step(1800.0).ok());
  EXPECT_NEAR(simulation->tissue().cells.rows[0].target_volume / kVolume, 1.5, 1e-6);
  EXPECT_NEAR(simulation->values().volume[0] / kVolume, 1.5, 1.5e-3);
}

}  // namespace
}  // namespace morula
