// Loads, shapes of regions and values of triggers that a program adds.
#include <cmath>

#include "coupling/cell_view.h"
#include "coupling/loads/load.h"
#include "coupling/regions/region.h"
#include "tests/scenarios/own_parts.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;
using Kind = OwnKey::Kind;

/// Pushes every node towards the plane through the origin.
std::shared_ptr<const morula::Load> squeeze() {
  return std::make_shared<const morula::Load>(morula::Load{
      .info = {.name = "squeeze",
               .title = "Force towards a plane",
               .equation = "F_i = −k (x_i·n) n/m",
               .source = "a test",
               .parameters = {given_by_study("stiffness", "tension", "nN/µm", "k.")}},
      .section = {.name = "squeeze", .doc = "Every node is pushed towards a plane.", .example = "{stiffness: 1 mN/m}"},
      .keys = {{Kind::kQuantity,
                {.name = "stiffness",
                 .doc = "k of all nodes together.",
                 .quantity = Quantity::kTension,
                 .fallback = "2 mN/m",
                 .low = 0.0,
                 .example = "1 mN/m",
                 .source = "a test"}},
               {Kind::kDirection,
                {.name = "normal", .doc = "n of the plane.", .fallback = "[0, 0, 1]", .example = "[0, 0, 1]", .source = "a test"}}},
      .push = [](const CellLoad& load, const LoadedShell& shell, std::span<Vec3d> force) {
        const Vec3d n = load.values.vector("normal");
        const double k = load.values("stiffness") * shell.strength / static_cast<double>(force.size());
        for (std::size_t i = 0; i < force.size(); ++i) force[i] -= n * (k * dot(shell.position[i], n));
      }});
}

std::shared_ptr<const RegionShape> rod() {
  return std::make_shared<const RegionShape>(RegionShape{
      .info = {.name = "rod",
               .title = "Region that is an endless rod",
               .equation = "|(x − c) − ((x − c)·a) a| < w",
               .source = "a test",
               .parameters = {given_by_study("width", "length", "µm", "w.")}},
      .keys = {{Kind::kQuantity,
                {.name = "width", .doc = "Of a rod.", .quantity = Quantity::kLength, .required = true, .low = 0.0, .example = "5 um"}},
               {Kind::kDirection,
                {.name = "along", .doc = "Of a rod.", .fallback = "[1, 0, 0]", .example = "[1, 0, 0]", .source = "a test"}}},
      .distance = [](const Region& region, const Vec3d& from) {
        const Vec3d a = region.values.vector("along");
        return norm(from - a * dot(from, a)) - region.values("width");
      }});
}

std::shared_ptr<const TriggerValue> age() {
  return std::make_shared<const TriggerValue>(
      TriggerValue{.info = {.name = "time_alive",
                            .title = "Age of a cell",
                            .equation = "t − t_birth",
                            .source = "a test",
                            .parameters = {given_by_study("promote", "time", "s", "Age of shells.")}},
                   .quantity = Quantity::kTime,
                   .example = "time_alive > 1 h",
                   .awaited = "cells that age",
                   .of = [](const Trigger&, const CellView& cell) { return cell.age(); }});
}

class OwnForces : public OwnParts {
 protected:
  OwnForces()
      : OwnParts([](Laws& laws) {
          laws.loads.push_back(squeeze());
          laws.region_shapes.push_back(rod());
          laws.trigger_values.push_back(age());
        }) {}
};

std::string one_cell(const std::string& more, const std::string& body = "shell") {
  return R"(schema: 1
study: one
time: {end: 4 min, output: 1 min, checkpoint: 2 min}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  cell: {radius: 6 um, body: )" +
         body + R"(, dcm: {nodes: 42}}
contact: {range: 1 um}
initial:
  - {type: cell, at: [[0 um, 0 um, 0 um]]}
  - {type: cell, at: [[30 um, 30 um, 30 um]]}
output: {report: false}
)" + more;
}

TEST_F(OwnForces, OfALoadMoveTheNodes) {
  const std::string text =
      one_cell("loads: {flat: {type: cell, squeeze: {stiffness: 0.2 mN/m}, course: [{time: 0 s, factor: 0}, {time: 2 min, factor: 1}]}}\n");
  run_whole(text, "flat");
  run_whole(one_cell(""), "free");
  EXPECT_GT(column("flat", "mean_pressure").back(), 10.0 * std::abs(column("free", "mean_pressure").back()) + 1e-4);
  const std::string methods = file("flat", "methods.md");
  EXPECT_THAT(methods, HasSubstr("Force towards a plane"));
  EXPECT_THAT(file("flat", "study.resolved.yaml"), HasSubstr("normal: [0, 0, 1]"));
  const RunSummary whole = run_whole(text, "whole", 2);
  EXPECT_EQ(run_split(text, "split", 120.0).final_state.state_hash, whole.final_state.state_hash);
}

TEST_F(OwnForces, OfALoadAreCheckedAndExplained) {
  const auto errors = [&](const std::string& load) {
    const auto study = read(one_cell("loads: {flat: {type: cell, " + load + "}}\n"), options());
    return study.ok() ? std::string() : study.error().text();
  };
  EXPECT_EQ(errors("squeeze: {}"), "");
  EXPECT_THAT(errors("squeeze: {stiffness: -1 mN/m}"), HasSubstr("[E302]"));
  EXPECT_THAT(errors("squeeze: {normal: [0, 0, 0]}"), HasSubstr("'normal' has no direction [E302]"));
  EXPECT_THAT(errors("squeeze: {}, pull: {force: 1 nN}"), HasSubstr("more than one kind of force"));
  EXPECT_THAT(errors("course: []"), HasSubstr("`body_force`, `squeeze`"));
  EXPECT_THAT(explain("squeeze.stiffness"), HasSubstr("default:  2 mN/m"));
}

TEST_F(OwnForces, ShapesOfRegionsDecideWhoIsAShell) {
  run_whole(one_cell("coupling: {regions: [{name: core, shape: rod, width: 8 um, along: [0, 1, 0]}]}\n", "sphere"), "rod");
  EXPECT_EQ(column("rod", "shell_count").back(), 1.0);
  EXPECT_THAT(file("rod", "methods.md"), HasSubstr("endless rod"));
  const auto errors = [&](const std::string& region) {
    const auto study = read(one_cell("coupling: {regions: [{name: core, " + region + "}]}\n", "sphere"), options());
    return study.ok() ? std::string() : study.error().text();
  };
  EXPECT_THAT(errors("shape: rod"), HasSubstr("a region of shape 'rod' needs `width` [E103]"));
  EXPECT_THAT(errors("shape: rod, width: 3 um, radius: 3 um"), HasSubstr("a region of shape 'rod' has no `radius` [E111]"));
  EXPECT_THAT(explain("regions.width"), HasSubstr("Of a rod."));
  EXPECT_THAT(explain("regions.shape"), HasSubstr("`rod`"));
}

TEST_F(OwnForces, ValuesOfTriggersDecideWhoIsAShell) {
  run_whole(one_cell("coupling: {triggers: [{promote: time_alive > 90 s, demote: time_alive < 30 s, hold: 10 s}]}\n", "sphere"), "age");
  const auto shells = column("age", "shell_count");
  EXPECT_EQ(shells[1], 0.0);
  EXPECT_EQ(shells.back(), 2.0);
  EXPECT_THAT(file("age", "events.jsonl"), HasSubstr("time_alive"));
  EXPECT_THAT(file("age", "methods.md"), HasSubstr("Age of a cell"));
  EXPECT_THAT(explain("triggers.promote"),
              HasSubstr("`pressure`, `pressure_rise`, `packing`, `outside_law`, `age`, `contact_share`, `time_alive` or a field"));
  const auto wrong =
      read(one_cell("coupling: {triggers: [{promote: time_alive > 1 kPa, demote: time_alive < 30 s}]}\n", "sphere"), options());
  ASSERT_FALSE(wrong.ok());
  EXPECT_THAT(wrong.error().text(), HasSubstr("[E203]"));
}

}  // namespace
}  // namespace morula::scenarios::test
