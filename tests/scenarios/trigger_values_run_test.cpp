/// Cells that become shells by one of their values, or in a phase of their cycle: studies with default parameters.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenarios/own_parts.h"
#include "tests/scenarios/simulation_of.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

std::string study_of(int count, const std::string& trigger) {
  return "schema: 1\nstudy: triggers\nseed: 1\ntime: {end: 40 min}\ndomain: {size: [200 um, 200 um, 200 um]}\n"
         "cell_types:\n  cell: {radius: 6 um, cycle: {model: none}, dcm: {nodes: 42}}\n"
         "initial:\n  - {type: cell, count: " +
         std::to_string(count) + ", fill: sphere, radius: 27 um}\ncoupling: {triggers: [{" + trigger +
         ", hold: 1 min}]}\noutput: {report: false}\n";
}

/// The tissue at some time [s].
std::unique_ptr<Simulation> run_to(const std::string& text, double time) {
  const auto study = test::read(text);
  EXPECT_TRUE(study.ok()) << study.error().text();
  auto made = test::simulation_of(*study);
  EXPECT_TRUE(made.ok());
  while ((*made)->tissue().clock.time < time) EXPECT_TRUE((*made)->step(time).ok());
  return std::move(*made);
}

TEST(TriggerValues, CellsThatAreOldEnoughBecomeShells) {
  const std::string text = study_of(2, "promote: age > 20 min, demote: age < 10 min");
  EXPECT_EQ(run_to(text, 1190.0)->tissue().shells.size(), 0u);
  EXPECT_EQ(run_to(text, 1500.0)->tissue().shells.size(), 2u);  // one in a step
}

TEST(TriggerValues, CellsAtTheBorderOfATissueBecomeShells) {
  const auto simulation = run_to(study_of(60, "promote: contact_share < 0.2, demote: contact_share > 0.9"), 2400.0);
  const Tissue& tissue = simulation->tissue();
  const std::vector<Vec3d> center = simulation->centers();
  Vec3d middle{};
  for (const Vec3d& c : center) middle += c * (1.0 / static_cast<double>(center.size()));
  double of_shells = 0.0, of_spheres = 0.0;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) (body.is_shell ? of_shells : of_spheres) += norm(center[body.row] - middle);
  ASSERT_GT(tissue.shells.size(), 5u);  // one in a step
  ASSERT_GT(tissue.spheres.size(), 3u);
  EXPECT_GT(of_shells / static_cast<double>(tissue.shells.size()), 1.25 * of_spheres / static_cast<double>(tissue.spheres.size()));
}

// φ of two equal balls at a distance d: h²(3R − h)/(4R³) behind the plane between them, h = R − d/2; 1.603 % at d = 1.7 R.
TEST(TriggerValues, CellsThatArePackedTightlyBecomeShells) {
  const auto shells_with = [](const std::string& promote) {
    return run_to(
               "schema: 1\nstudy: packed\nseed: 1\ntime: {end: 1 min}\ndomain: {size: [60 um, 60 um, 60 um]}\n"
               "cell_types:\n  cell: {radius: 6 um, cycle: {model: none}, dcm: {nodes: 42}}\n"
               "initial:\n  - {type: cell, at: [[-5.1 um, 0 um, 0 um], [5.1 um, 0 um, 0 um]]}\n"
               "coupling: {triggers: [{promote: packing > " +
                   promote + ", demote: packing < 0.1 %, hold: 10 min}]}\noutput: {report: false}\nlimits: {overlap: 5 um}\n",
               1.0)
        ->tissue()
        .shells.size();
  };
  EXPECT_EQ(shells_with("1.62 %"), 0u);
  EXPECT_GT(shells_with("1.55 %"), 0u);
}

// A box that shrinks by as much of its volume in each second: p = K_V ln(V0/V) of filled cells rises by 2.5 kPa ln(0.95/0.85)/100 min = 2.8 Pa/min.
TEST(TriggerValues, CellsWhosePressureRisesFastBecomeShells) {
  const auto shells_with = [](const std::string& promote) {
    return run_to(
               "schema: 1\nstudy: pressed\nseed: 1\ntime: {end: 2 h}\n"
               "domain: {size: [28 um, 28 um, 28 um], boundary: periodic, course: [{time: 0 s, volume: 1}, {time: 100 min, volume: "
               "0.895}]}\n"
               "cell_types:\n  cell: {radius: 5 um, cycle: {model: none}, adhesion: {cell: 0 J/m^2}, dcm: {nodes: 42}}\n"
               "initial:\n  - {type: cell, count: 42, fill: random, size: [28 um, 28 um, 28 um], start_volume: 50 %, inflate: 10 "
               "min}\n"
               "coupling: {regions: [{name: none, shape: box, size: [28 um, 28 um, 28 um], as: sphere, until: 50 min}], "
               "triggers: [{promote: pressure_rise > " +
                   promote + ", demote: pressure_rise < -1 Pa, hold: 2 h}]}\noutput: {report: false}\n",
               3600.0)
        ->tissue()
        .shells.size();
  };
  EXPECT_GT(shells_with("1 Pa"), 15u);
  EXPECT_LT(shells_with("8 Pa"), 3u);
}

TEST(TriggerValues, CellsInAPhaseAreShells) {
  const std::string text =
      "schema: 1\nstudy: phases\nseed: 1\ntime: {end: 1 h}\ndomain: {size: [200 um, 200 um, 200 um]}\n"
      "cell_types:\n  cell: {radius: 6 um, dcm: {nodes: 42}, cycle: {model: phases, growth: none, phases: "
      "{first: {duration: 20 min}, second: {duration: 20 min}, third: {duration: 10 h}}}}\n"
      "initial:\n  - {type: cell, count: 3, fill: sphere, radius: 40 um, age: birth}\n"
      "coupling: {triggers: [{phase: second, hold: 1 min}], hold: 1 min}\noutput: {report: false}\n";
  EXPECT_EQ(run_to(text, 1150.0)->tissue().shells.size(), 0u);
  EXPECT_EQ(run_to(text, 1800.0)->tissue().shells.size(), 3u);  // one in a step
  EXPECT_EQ(run_to(text, 3000.0)->tissue().shells.size(), 0u);
}

/// The hold of regions (10 min) is none of a study without one.
TEST(TriggerValues, CellsGoBackAfterTheHoldOfTheirTrigger) {
  const std::string text =
      "schema: 1\nstudy: phases\nseed: 1\ntime: {end: 1 h}\ndomain: {size: [200 um, 200 um, 200 um]}\n"
      "cell_types:\n  cell: {radius: 6 um, dcm: {nodes: 42}, cycle: {model: phases, growth: none, phases: "
      "{first: {duration: 20 min}, second: {duration: 3 min}, third: {duration: 10 h}}}}\n"
      "initial:\n  - {type: cell, count: 1, fill: sphere, radius: 40 um, age: birth}\n"
      "coupling: {triggers: [{phase: second, hold: 1 min}]}\noutput: {report: false}\n";
  EXPECT_EQ(run_to(text, 1370.0)->tissue().shells.size(), 1u);
  EXPECT_EQ(run_to(text, 1510.0)->tissue().shells.size(), 0u);
}

/// Cells that bear 9.39 Pa when the run begins (Hertz: R* 3 µm, δ 1.8 µm) bear it from before: it is no rise, and more than 5 Pa.
TEST(TriggerValues, WhatPressesCellsAtTheStartIsThere) {
  const auto shells_with = [](const std::string& trigger) {
    const auto study = test::read(
        "schema: 1\nstudy: pair\ntime: {end: 5 min}\ndomain: {size: [60 um, 60 um, 60 um]}\n"
        "cell_types:\n  cell: {radius: 6 um, cycle: {model: none}, adhesion: {cell: 0 J/m^2}, cbm: {law: hertz, packing: none}, dcm: "
        "{nodes: 42}}\n"
        "initial:\n  - {type: cell, at: [[-5.1 um, 0 um, 0 um], [5.1 um, 0 um, 0 um]]}\n"
        "coupling: {triggers: [{" +
        trigger + "}]}\noutput: {report: false}\nlimits: {overlap: 5 um}\n");
    EXPECT_TRUE(study.ok()) << study.error().text();
    auto made = test::simulation_of(*study);
    EXPECT_TRUE(made.ok() && (*made)->first_swaps().ok());
    std::size_t most = (*made)->tissue().shells.size();
    for (const double until : {1.0, 30.0}) {
      while ((*made)->tissue().clock.time < until) EXPECT_TRUE((*made)->step(until).ok());
      most = std::max(most, (*made)->tissue().shells.size());
    }
    return most;
  };
  EXPECT_EQ(shells_with("promote: pressure_rise > 5 Pa, demote: pressure_rise < -5 Pa, hold: 1 min"), 0u);
  EXPECT_EQ(shells_with("promote: pressure < 5 Pa, demote: pressure > 8 Pa, hold: 1 min"), 0u);
  EXPECT_EQ(shells_with("promote: pressure > 9 Pa, demote: pressure < 1 Pa, hold: 1 min"), 2u);
}

/// In a box that shrinks to 0.3 of its volume regions go along: 15 µm from the middle is 10 µm then, and the cell of the other half never is within it.
TEST(RegionsInAChangingBox, GoAlongWithIt) {
  const auto made = run_to(
      "schema: 1\nstudy: halves\ntime: {end: 1 h}\n"
      "domain: {size: [60 um, 60 um, 60 um], boundary: periodic, course: [{time: 0 s, volume: 1}, {time: 40 min, volume: 0.3}]}\n"
      "cell_types:\n  cell: {radius: 6 um, cycle: {model: none}, dcm: {nodes: 42}}\n"
      "initial:\n  - {type: cell, at: [[15 um, 0 um, 0 um], [-28.5 um, 0 um, 0 um]]}\n"
      "coupling: {regions: [{name: right, shape: box, center: [15 um, 0 um, 0 um], size: [30 um, 60 um, 60 um]}]}\noutput: {report: "
      "false}\n",
      2700.0);
  const Tissue& tissue = made->tissue();
  ASSERT_EQ(tissue.shells.size(), 1u);
  for (const BodyOfRow& body : bodies_of(tissue.cells)) EXPECT_EQ(body.is_shell, made->centers()[body.row].x > 0.0);
}

class TriggersAtTheStart : public test::OwnParts {
 protected:
  TriggersAtTheStart() : OwnParts([](Laws&) {}) {}

  double shells(const std::string& type, const std::string& places, const std::string& trigger) {
    const std::string name = "run" + std::to_string(runs_++);
    run_whole(
        "schema: 1\nstudy: start\ntime: {end: 2 s, output: 1 s}\ndomain: {size: [200 um, 200 um, 200 um]}\n"
        "cell_types:\n  a: {adhesion: {a: 0.1 mN/m}, cycle: {model: none}, " +
            type + "}\ninitial:\n  - {type: a, at: [" + places + "]}\ncoupling: {triggers: [{" + trigger + "}]}\noutput: {report: false}\n",
        name);
    return column(name, "shell_count").front();
  }

  int runs_ = 0;
};

/// Rules look at what cells touch at time 0, too: cells that begin in contact adhere then (a share of 0.030 by JKR, of 0.006 by Hertz).
TEST_F(TriggersAtTheStart, LookAtCellsThatAdhere) {
  const std::string pair = "[0 um, 0 um, 0 um], [11.7 um, 0 um, 0 um]";
  EXPECT_EQ(shells("radius: 6 um", pair, "promote: contact_share < 0.02, demote: contact_share > 0.035"), 0.0);
  EXPECT_EQ(shells("radius: 6 um", pair, "promote: contact_share > 0.02, demote: contact_share < 0.01"), 2.0);
  std::string cube;
  for (int k = 0; k < 8; ++k)
    cube += (k > 0 ? ", [" : "[") + std::string(k & 1 ? "9.99 um, " : "0 um, ") + (k & 2 ? "9.99 um, " : "0 um, ") +
            (k & 4 ? "9.99 um]" : "0 um]");
  EXPECT_EQ(shells("radius: 5 um, cbm: {young: 0.45 kPa, packing: none}", cube, "outside_law: 1"), 8.0);
}

}  // namespace
}  // namespace morula::scenarios
