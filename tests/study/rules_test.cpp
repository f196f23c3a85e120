// Rules that no cell ever meets, or that are never asked, are told by `check`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// What is told of cells in a field that has 0.2 mM at first and on all faces; TYPE, FIELD and the rules are put in.
std::string told(const std::string& rules, const std::string& type = "", const std::string& field = "") {
  return warnings_of(R"(schema: 1
study: rules
time: {end: 10 h}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  cell: {radius: 6 um)" +
                     type + R"(}
fields:
  oxygen: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, voxel: 20 um)" +
                     (field.empty() ? ", boundary: {all: 0.2 mM}" : field) + R"(}
initial:
  - {type: cell, count: 10, fill: sphere, radius: 40 um}
)" + rules);
}

std::string trigger(const std::string& promote, const std::string& demote) {
  return "coupling: {triggers: [{promote: oxygen " + promote + ", demote: oxygen " + demote + "}]}\n";
}
std::string level(const std::string& level, const std::string& side) {
  return "coupling: {regions: [{name: poor, shape: level, field: oxygen, level: " + level + ", side: " + side + "}]}\n";
}
const std::string kConsumed = ", boundary: {all: 0.2 mM}, uptake: {cell: {rate: 10 amol/s, half_saturation: 0.01 mM}}";

TEST(Rules, OfLevelsThatAFieldNeverHasAreTold) {
  EXPECT_THAT(told(trigger("< 0.1 mM", "> 0.15 mM")),
              AllOf(HasSubstr("nobody ever meets `oxygen < 0.1 mM`"), HasSubstr("'oxygen' never falls below 200 uM"), HasSubstr("[E694]")));
  EXPECT_THAT(told(trigger("> 0.3 mM", "< 0.25 mM"), "", kConsumed), HasSubstr("'oxygen' never rises above 200 uM"));
  EXPECT_THAT(told(trigger("> 0.1 mM", "< 0.05 mM")), HasSubstr("everybody meets `oxygen > 0.1 mM`"));
  EXPECT_THAT(told(level("0.1 mM", "below")), HasSubstr("nobody ever meets region 'poor'"));
  EXPECT_THAT(told(level("0.1 mM", "above")), HasSubstr("everybody meets region 'poor'"));
}

TEST(Rules, OfLevelsThatAFieldMayHaveAreNotTold) {
  EXPECT_THAT(told(trigger("< 0.1 mM", "> 0.15 mM"), "", kConsumed), Not(HasSubstr("E694"))) << "cells take it up";
  EXPECT_THAT(told(level("0.1 mM", "below"), "", ", boundary: {all: 0.2 mM, x_low: 0 mM}"), Not(HasSubstr("E694"))) << "a face has less";
  EXPECT_THAT(told(trigger("> 0.3 mM", "< 0.25 mM"), "", ", boundary: {all: 0.2 mM}, secretion: {cell: {rate: 10 amol/s}}"),
              Not(HasSubstr("E694")))
      << "cells make it";
  EXPECT_THAT(
      told(trigger("> 0.3 mM", "< 0.25 mM"), "", ", boundary: {all: 0.2 mM}, course: [{time: 0 h, factor: 1}, {time: 1 h, factor: 2}]"),
      Not(HasSubstr("E694")))
      << "the faces get more";
  EXPECT_THAT(told(trigger("< 0.1 mM", "> 0.15 mM"), "", ", boundary: {all: no_flux}, decay: 1e-4 1/s"), Not(HasSubstr("E694")));
}

TEST(Rules, OfDeathAndMigrationInAFieldThatGivesNoCauseAreTold) {
  const std::string death = ", cycle: {duration: 18 h}, death: {field: oxygen, below: 0.05 mM, rate: 0.1 1/h}";
  EXPECT_THAT(told("", death), AllOf(HasSubstr("no cell of 'cell' dies: 'oxygen' never falls below 200 uM"), HasSubstr("[E694]")));
  EXPECT_THAT(told("", death, kConsumed), Not(HasSubstr("E694")));
  const std::string crawls = ", migration: {law: chemotaxis, field: oxygen, speed: 10 um/h}";
  EXPECT_THAT(told("", crawls), AllOf(HasSubstr("cells of 'cell' walk at random: 'oxygen' is the same everywhere"), HasSubstr("[E694]")));
  EXPECT_THAT(told("", crawls, kConsumed), Not(HasSubstr("E694")));
}

/// Cells of 6 µm and voxels of 20 µm.
TEST(Rules, OfMigrationByWhatCellsMakeThemselvesAreTold) {
  const std::string crawls = ", migration: {law: chemotaxis, field: oxygen, speed: 10 um/h}";
  const std::string made = ", boundary: {all: 0.2 mM}, secretion: {cell: {rate: 10 amol/s}}";
  EXPECT_THAT(told("", crawls, made),
              AllOf(HasSubstr("each is drawn to the middle of its voxel by its own"), HasSubstr("[E512]"), HasSubstr("`voxel: 4.8 um`")));
  EXPECT_THAT(told("", crawls, kConsumed), Not(HasSubstr("E512")));
  EXPECT_THAT(told("", "", made), Not(HasSubstr("E512")));
}

TEST(Rules, BehindARegionThatHoldsEveryCellAreTold) {
  const std::string all = "{name: all, shape: everything, as: sphere}", core = "{name: core, shape: sphere, radius: 10 um, as: shell}";
  EXPECT_THAT(told("coupling: {regions: [" + all + ", " + core + "]}\n"),
              AllOf(HasSubstr("no cell is a shell by region 'core': region 'all' comes before it"), HasSubstr("[E694]")));
  EXPECT_THAT(told("coupling: {regions: [" + core + ", " + all + "]}\n"), Not(HasSubstr("E694")));
  const std::string late = "{name: all, shape: everything, as: sphere, from: 5 h}";
  EXPECT_THAT(told("coupling: {regions: [" + late + ", " + core + "]}\n"), Not(HasSubstr("E694"))) << "before 5 h the other one is asked";
  EXPECT_THAT(told("coupling: {regions: [" + all + "], triggers: [{promote: pressure > 1 kPa, demote: pressure < 500 Pa}]}\n"),
              AllOf(HasSubstr("no trigger is asked"), HasSubstr("[E694]")));
}

}  // namespace
}  // namespace morula::scenarios::test
