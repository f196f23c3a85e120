#pragma once
#include <string>

#include "coupling/behaviours/behaviour.h"
#include "coupling/cell_view.h"
#include "coupling/laws.h"
#include "coupling/observables/observable.h"

namespace morula::scenarios::test {

inline KeySpec pressure_key(const char* name, const char* doc) {
  return {.name = name, .doc = doc, .quantity = Quantity::kPressure, .required = true, .low = 0.0, .example = "100 Pa"};
}

/// Cells that are pressed upon die at a rate; in the section of death by lack of a field.
inline std::shared_ptr<const Behaviour> death_by_pressure() {
  return std::make_shared<const Behaviour>(
      Behaviour{.info = {.name = "death_by_pressure",
                         .title = "Death under pressure",
                         .equation = "P(death in Δt) = 1 − e^(−rate·Δt) while p > pressure_above",
                         .source = "a test",
                         .parameters = {given_by_study("pressure_above", "pressure", "kPa", "Pressure above which cells may die."),
                                        given_by_study("pressure_rate", "rate", "1/s", "Deaths per time.")}},
                .section = {.name = "death", .example = "{pressure_above: 100 Pa}"},
                .keys = {{OwnKey::Kind::kQuantity, pressure_key("pressure_above", "Pressure above which cells may die.")},
                         {OwnKey::Kind::kQuantity,
                          {.name = "pressure_rate",
                           .doc = "Probability of death per time.",
                           .quantity = Quantity::kRate,
                           .fallback = "60 1/h",
                           .low = 0.0,
                           .example = "60 1/h",
                           .source = "a test"}}},
                .build = [](const OwnValues& values) -> Behave {
                  return [above = values("pressure_above"), rate = values("pressure_rate")](const CellStep& step, CellWish& wish) {
                    if (step.cell.row().pressure > above && step.happens(rate)) wish.die = true;
                  };
                },
                .judge = [](const OwnValues& values) -> std::optional<LawProblem> {
                  if (values("pressure_above") < 100.0) return std::nullopt;
                  return LawProblem{510, "pressure_above", "no cell bears {}", "less"};
                }});
}

/// Cells count the time for which their body is pressed upon, and stop growing when it is too long.
inline std::shared_ptr<const Behaviour> exhaustion() {
  return std::make_shared<const Behaviour>(Behaviour{
      .info =
          {.name = "exhaustion", .title = "Exhaustion", .equation = "dt_p/dt = 1 while p > above", .source = "a test", .parameters = {}},
      .section = {.name = "exhaustion", .doc = "Cells tire under pressure.", .example = "{above: 100 Pa}"},
      .keys = {{OwnKey::Kind::kQuantity, pressure_key("above", "Pressure that tires.")}},
      .variables = {{.name = "pressed", .unit = "s"}},
      .looks_at_body = true,
      .build = [](const OwnValues& values) -> Behave {
        return [above = values("above")](const CellStep& step, CellWish& wish) {
          if (step.cell.pressure > above) step.state[0] += step.dt;
          if (step.state[0] > 120.0) wish.growth = 0.0;
        };
      }});
}

/// Both behaviours, and a column of series.csv that looks at what one of them remembers.
inline void add_pressed_cells(Laws& laws) {
  laws.behaviours.push_back(death_by_pressure());
  laws.behaviours.push_back(exhaustion());
  laws.observables.emplace_back([](const Model&) {
    return std::vector<Observable>{{"pressed", "s", "Mean time under pressure.", [](const Moment& m) {
                                      return m.cells.mean([](const CellView& c) { return c.variable("exhaustion/pressed"); });
                                    }}};
  });
}

/// Three cells under a load and two that are free, of types with these behaviours.
inline std::string two_types(const std::string& own) {
  return R"(schema: 1
study: pressed
time: {end: 10 min, output: 5 min, checkpoint: 5 min}
domain: {size: [150 um, 150 um, 150 um]}
cell_types:
  pressed: {radius: 6 um, body: shell, dcm: {nodes: 42}, cycle: {duration: 10 h}, )" +
         own + R"(}
  free: {like: pressed}
contact: {range: 1 um}
initial:
  - {type: pressed, at: [[0 um, 0 um, 20 um], [0 um, 0 um, -20 um], [40 um, 0 um, 0 um]]}
  - {type: free, at: [[0 um, 40 um, 20 um], [0 um, 40 um, -20 um]]}
loads:
  press: {type: pressed, pressure: {value: 200 Pa}}
output: {report: false}
)";
}

inline const std::string kDeath = "death: {pressure_above: 100 Pa, shrink_time: 20 min}";
inline const std::string kTired = "exhaustion: {above: 100 Pa}";

}  // namespace morula::scenarios::test
