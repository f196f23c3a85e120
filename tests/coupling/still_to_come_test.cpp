// What keeps a tissue awake in which nothing moves: each cause alone, and none.
#include "coupling/still_to_come.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "coupling/behaviours/osmosis.h"
#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// From 0 to 1 at a time, in a straight line from 0 on.
TimeCourse until(double time) { return {{0.0, time}, {0.0, 1.0}}; }

CellLoad pull_until(double time) {
  CellLoad out;
  out.name = "pull", out.course = until(time);
  return out;
}

TensionRegion tension_of_all() {
  TensionRegion out;
  out.tension = 0.5;
  return out;
}

constexpr BodyKind kSphere = BodyKind::kSphere, kShell = BodyKind::kShell;

Model quiet_model() {
  Model model = test::clusters_model(0.0);
  model.types[0].initial_body = kSphere;
  return model;
}

/// A sphere and a shell of 42 nodes far from each other, or this far, which rest; `change` may disturb them.
std::vector<std::string> coming(const Model& model, const std::function<void(Tissue&)>& change = {}, double distance = 60.0) {
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{-0.5 * distance, 0, 0}, {0.5 * distance, 0, 0}}, {kSphere, kShell}, 42);
  for (CellRow& row : tissue.cells.rows) row.phase = Phase::kResting, row.own_body = row.body;
  tissue.clock.time = 1000.0;
  if (change) change(tissue);
  return Simulation::create(model, std::move(tissue), Comm(), 1).value()->still_to_come();
}

std::size_t sphere_of(const Tissue& tissue) { return tissue.cells.rows[0].body == kSphere ? 0 : 1; }

TEST(StillToCome, NothingWhereCellsOnlyRest) {
  EXPECT_THAT(coming(quiet_model()), IsEmpty());
  Model model = quiet_model();  // what is over does not count
  model.loads.push_back(pull_until(1000.0));
  model.swaps.regions.push_back({.name = "past", .from = 100.0, .until = 900.0});
  model.types[0].regional_tension.regions = {tension_of_all()};
  model.types[0].regional_tension.regions[0].course = until(500.0);
  EXPECT_THAT(coming(model), IsEmpty());
}

TEST(StillToCome, WhatIsPrescribedOverTime) {
  Model load = quiet_model();
  load.loads.push_back(pull_until(1000.5));
  EXPECT_THAT(coming(load), ElementsAre("a course over time"));
  Model tension = quiet_model();
  tension.types[0].regional_tension.regions = {tension_of_all()};
  tension.types[0].regional_tension.regions[0].course = until(5000.0);
  EXPECT_THAT(coming(tension), ElementsAre("a course over time"));
  Model medium = quiet_model();
  medium.types[0].osmosis.course = until(5000.0);
  EXPECT_THAT(coming(medium), ElementsAre("a course over time"));
  Model swing = quiet_model();
  swing.types[0].regional_tension.regions = {tension_of_all()};
  swing.types[0].regional_tension.regions[0].amplitude = 0.2;
  swing.types[0].regional_tension.regions[0].period = 100.0;
  EXPECT_THAT(coming(swing), ElementsAre("a tension that swings"));
  Model plate = quiet_model();
  plate.obstacles.push_back({.name = "plate",
                             .position = {{50, 50, 50}, {60, 50, 50}, {50, 60, 50}, {50, 50, 60}},
                             .faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
                             .velocity = {0, 0, 1e-6}});
  plate.pairs.assign(4, ContactPair{0.0, 50.0, 50.0});
  EXPECT_THAT(coming(plate), ElementsAre("an obstacle that moves"));
}

TEST(StillToCome, RegionsThatBeginOrEnd) {
  for (const auto& [from, until] : {std::pair{2000.0, kNever}, {0.0, 2000.0}}) {
    Model model = quiet_model();
    model.swaps.regions.push_back({.name = "far", .center = {0, 150, 0}, .radius = 1.0, .from = from, .until = until});
    EXPECT_THAT(coming(model), ElementsAre("a region that begins or ends"));
  }
}

TEST(StillToCome, ExchangesThatWaitForTheirHoldTimeUnlessThereIsNoPlace) {
  Model model = quiet_model();
  model.swaps.regions.push_back({.name = "all", .shape = everything_region()});
  const auto just_swapped = [](Tissue& tissue) { tissue.cells.optional.last_swap_time.set(sphere_of(tissue), 900.0, 2); };
  EXPECT_THAT(coming(model, just_swapped), ElementsAre("an exchange of bodies"));
  model.swaps.max_shells = 1;
  EXPECT_THAT(coming(model, just_swapped), IsEmpty()) << "the shell there is takes the only place";
}

TEST(StillToCome, ShellsThatAreToBeSpheresUnlessTheyWouldBePackedTooTightly) {
  Model model = quiet_model();
  model.swaps.regions.push_back({.name = "all", .shape = everything_region(), .body = kSphere});
  model.types[0].sphere.packing =
      cbm::PackingCurve::through(std::vector<cbm::PackingKnot>{{0.001, 0.0}, {0.002, 0.001}, {0.003, 0.002}}).value();
  const auto just_swapped = [](Tissue& tissue) { tissue.cells.optional.last_swap_time.set(1 - sphere_of(tissue), 900.0, 2); };
  EXPECT_THAT(coming(model, just_swapped), ElementsAre("an exchange of bodies"));
  const double near =
      1.7 * model.types[0].radius.mean;  // balls lose v = πh²(R − h/3), h = 0.15 R, 1.6 % of their volume to the plane between them
  EXPECT_THAT(coming(model, just_swapped, near), IsEmpty()) << "it is put off for ever";
}

TEST(StillToCome, WhatCellsDo) {
  const auto of_sphere = [](auto&& change) {
    return [change](Tissue& tissue) { change(tissue, tissue.cells.rows[sphere_of(tissue)], sphere_of(tissue)); };
  };
  Model model = quiet_model();
  EXPECT_THAT(coming(model, of_sphere([](Tissue& t, CellRow&, std::size_t i) { t.cells.optional.inflation_left.set(i, 1.0, 2); })),
              ElementsAre("inflation"));
  EXPECT_THAT(coming(model, of_sphere([](Tissue&, CellRow& row, std::size_t) { row.phase = Phase::kDying; })),
              ElementsAre("the end of dying cells"));
  EXPECT_THAT(coming(model, of_sphere([](Tissue&, CellRow& row, std::size_t) { row.phase = Phase::kWaiting; })), ElementsAre("a division"));
  EXPECT_THAT(coming(model, of_sphere([](Tissue& t, CellRow&, std::size_t i) { t.cells.optional.reference_excess.set(i, 0.05, 2); })),
              ElementsAre("easing after an exchange of bodies"));
  for (const auto& [age, what] : {std::pair{1799.0, 1u}, {1801.0, 0u}})
    EXPECT_EQ(coming(model, of_sphere([age = age](Tissue&, CellRow& row, std::size_t) {
                       row.id = CellId::founder(7).daughter(0);
                       row.birth_time = 1000.0 - age;
                     })),
              std::vector<std::string>(what, "young sisters"));
  EXPECT_THAT(coming(model, [](Tissue& tissue) { tissue.clock.capped = true; }), ElementsAre("the end of the capped start"));
}

TEST(StillToCome, GrowthUnlessPressureHoldsItOrTheCellWaitsAsAShell) {
  Model model = quiet_model();
  model.types[0].cycles = true;
  model.types[0].inhibit_pressure = 1.0;
  const auto with = [&](Phase phase, double pressure) {
    return coming(model, [=](Tissue& tissue) {
      for (CellRow& row : tissue.cells.rows) row.phase = row.body == kShell ? Phase::kWaiting : phase, row.pressure = pressure;
    });
  };
  EXPECT_THAT(with(Phase::kGrowing, 0.0), ElementsAre("growth"));
  EXPECT_THAT(with(Phase::kGrowing, 1.1), IsEmpty());
  EXPECT_THAT(with(Phase::kResting, 0.0), IsEmpty());
}

TEST(StillToCome, FieldsThatCellsAnswerTo) {
  Model model = quiet_model();
  model.fields.resize(1);
  model.fields[0].name = "oxygen";
  model.fields[0].initial = 0.2;
  model.fields[0].voxel = 40.0;
  EXPECT_THAT(coming(model), IsEmpty()) << "nobody answers";
  const auto starve = [&](double rate) {
    OwnValues values;
    values.set("field", 0), values.set("below", 0.0), values.set("rate", rate);
    model.types[0].behaviours = {CellBehaviour(starvation(), values, "cell")};
  };
  starve(1e-4);
  EXPECT_THAT(coming(model), ElementsAre("fields that cells answer to"));
  starve(0.0);
  EXPECT_THAT(coming(model), IsEmpty());
  model.swaps.triggers.push_back({.value = field_value(), .field = 0, .promote = 100.0, .demote = -1.0});
  EXPECT_THAT(coming(model), testing::Contains("fields that cells answer to"));
}

TEST(StillToCome, CellsThatDriveThemselves) {
  const std::function<void(CellType&)> drives[] = {[](CellType& t) { t.migration.speed = 1e-3; },
                                                   [](CellType& t) { t.fluctuations.energy = 1e-6; },
                                                   [](CellType& t) {
                                                     t.protrusion.force = 0.1;
                                                     OwnValues values;
                                                     values.set("turning", 1e-4);
                                                     t.polarity.set = true;
                                                     t.polarity.add(polarity_rules().front(), values);
                                                   }};
  for (const auto& drive : drives) {
    Model model = quiet_model();
    drive(model.types[0]);
    EXPECT_THAT(coming(model), ElementsAre("cells that drive themselves"));
  }
}

/// In a medium of 300 mM around cells of 300 mM the two cells differ from their rest by their cortex alone, which the osmotic pressure outweighs.
TEST(StillToCome, WaterThatFlows) {
  Model model = quiet_model();
  model.types[0].osmosis.permeability = 1e-4;
  EXPECT_THAT(coming(model), IsEmpty());
  model.types[0].osmosis.outside = 310.0;
  EXPECT_THAT(coming(model), ElementsAre("water that flows"));
}

/// Two shells that touch: the lateral tension is eased over a minute, from none at the start.
TEST(StillToCome, TensionsThatFollowContact) {
  Model model = test::clusters_model(0.1);
  model.types[0].initial_body = kShell;
  model.types[0].regional_tension.regions = {tension_of_all()};
  model.types[0].regional_tension.regions[0].mark = TensionRegion::kLateral;
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{-5.9, 0, 0}, {5.9, 0, 0}}, {kShell, kShell}, 42);
  for (CellRow& row : tissue.cells.rows) row.phase = Phase::kResting, row.own_body = kShell;
  auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
  ASSERT_TRUE(simulation->step(1.0).ok());
  EXPECT_THAT(simulation->still_to_come(), ElementsAre("tensions that follow contact"));
}

}  // namespace
}  // namespace morula
