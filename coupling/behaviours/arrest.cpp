#include "coupling/behaviours/arrest.h"

#include <algorithm>
#include <cmath>

#include "coupling/cell_view.h"

namespace morula {
namespace {

using Kind = OwnKey::Kind;

std::shared_ptr<const ArrestFactor> make_factor(ArrestFactor factor) { return std::make_shared<const ArrestFactor>(std::move(factor)); }

KeySpec key(const char* name, const char* doc, Quantity quantity, double low, double high, const char* example) {
  return {.name = name, .doc = doc, .quantity = quantity, .required = true, .low = low, .high = high, .example = example};
}

KeySpec power_key() {
  return {.name = "power", .doc = "n: steepness.", .fallback = "2", .low = 0.1, .high = 100.0, .example = "4", .source = "chosen"};
}

LawParameter power_parameter() { return given_by_study("power", "number", "1", "n: steepness."); }

/// A ramp that goes down where the value rises.
std::optional<LawProblem> judge_rising(const OwnValues& values) {
  if (values("from") < values("to")) return std::nullopt;
  return LawProblem{510, "to", "the arrest is full at {}, not above where it begins", "set `to` above `from`"};
}

/// A ramp that goes down where the value falls.
std::optional<LawProblem> judge_falling(const OwnValues& values) {
  if (values("from") > values("to")) return std::nullopt;
  return LawProblem{510, "to", "the arrest is full at {}, not below where it begins", "set `to` below `from`"};
}

std::shared_ptr<const ArrestFactor> by_pressure() {
  return make_factor({.info = {.name = "arrest_by_pressure",
                               .title = "Arrest under pressure",
                               .equation = "g = min(1, max(0, (p2 − p)/(p2 − p1))), p averaged over the last minute, p1: `from`, p2: `to`",
                               .source = "physics/cbm.md §5",
                               .parameters = {given_by_study("from", "pressure", "kPa", "Pressure at which it begins."),
                                              given_by_study("to", "pressure", "kPa", "Pressure at which it is full.")}},
                      .section = {.name = "pressure",
                                  .doc = "By what neighbours, obstacles and loads press on the cell, averaged over a minute: a ramp.",
                                  .example = "{from: 200 Pa, to: 800 Pa}"},
                      .keys = {{Kind::kQuantity, key("from", "Up to here nothing is held back.", Quantity::kPressure, 0.0, 1e6, "200 Pa")},
                               {Kind::kQuantity, key("to", "From here on nothing goes on.", Quantity::kPressure, 0.0, 1e6, "800 Pa")}},
                      .build = [](const OwnValues& values) -> ArrestOf {
                        return [from = values("from"), to = values("to")](const CellView& cell) {
                          return ramp(cell.row().pressure, from, to);
                        };
                      },
                      .judge = &judge_rising,
                      .full_pressure = [](const OwnValues& values) { return values("to"); }});
}

std::shared_ptr<const ArrestFactor> by_pressure_hill() {
  return make_factor({.info = {.name = "arrest_by_pressure_hill",
                               .title = "Arrest under pressure, smooth",
                               .equation = "g = 1/(1 + (p/p_h)ⁿ), p averaged over the last minute; 1 for p < 0",
                               .source = "physics/cbm.md §5",
                               .parameters = {given_by_study("half", "pressure", "kPa", "p_h."), power_parameter()}},
                      .section = {.name = "pressure_hill",
                                  .doc = "By what presses on the cell, averaged over a minute: a Hill function.",
                                  .example = "{half: 400 Pa, power: 4}"},
                      .keys = {{Kind::kQuantity, key("half", "Pressure at which half is left.", Quantity::kPressure, 1e-9, 1e6, "400 Pa")},
                               {Kind::kQuantity, power_key()}},
                      .build = [](const OwnValues& values) -> ArrestOf {
                        return [half = values("half"), power = values("power")](const CellView& cell) {
                          return 1.0 - hill(cell.row().pressure, half, power);
                        };
                      }});
}

std::shared_ptr<const ArrestFactor> by_volume() {
  return make_factor({.info = {.name = "arrest_by_volume",
                               .title = "Arrest of compressed cells",
                               .equation = "g = min(1, max(0, (v − v2)/(v1 − v2))), v = V/V_t, V what its pressure leaves of the cell, V_t "
                                           "the target volume, v1: `from`, v2: `to`",
                               .source = "Van Liedekerke et al. 2019: growth by volumetric strain",
                               .parameters = {given_by_study("from", "fraction", "1", "V/V_t at which it begins."),
                                              given_by_study("to", "fraction", "1", "V/V_t at which it is full.")}},
                      .section = {.name = "volume",
                                  .doc = "By the volume of the body as a part of its target volume: a ramp.",
                                  .example = "{from: 95 %, to: 85 %}"},
                      .keys = {{Kind::kQuantity, key("from", "Down to here nothing is held back.", Quantity::kFraction, 0.0, 10.0, "95 %")},
                               {Kind::kQuantity, key("to", "From here down nothing goes on.", Quantity::kFraction, 0.0, 10.0, "85 %")}},
                      .looks_at_body = true,
                      .build = [](const OwnValues& values) -> ArrestOf {
                        return [from = values("from"), to = values("to")](const CellView& cell) {
                          return ramp(cell.pressed_volume() / cell.row().target_volume, from, to);
                        };
                      },
                      .judge = &judge_falling});
}

std::shared_ptr<const ArrestFactor> by_contact() {
  return make_factor(
      {.info = {.name = "arrest_by_contact",
                .title = "Arrest by contact",
                .equation =
                    "g = min(1, max(0, (a2 − a)/(a2 − a1))), a the part of the cell's surface that is in contact, a1: `from`, a2: `to`",
                .source = "contact inhibition: Eagle & Levine 1967, doi:10.1038/2131102a0",
                .parameters = {given_by_study("from", "fraction", "1", "Part at which it begins."),
                               given_by_study("to", "fraction", "1", "Part at which it is full.")}},
       .section = {.name = "contact",
                   .doc = "By the part of the cell's surface that is in contact: a ramp.",
                   .example = "{from: 50 %, to: 90 %}"},
       .keys = {{Kind::kQuantity, key("from", "Up to here nothing is held back.", Quantity::kFraction, 0.0, 1.0, "50 %")},
                {Kind::kQuantity, key("to", "From here on nothing goes on.", Quantity::kFraction, 0.0, 1.0, "90 %")}},
       .looks_at_body = true,
       .build = [](const OwnValues& values) -> ArrestOf {
         return [from = values("from"), to = values("to")](const CellView& cell) {
           return cell.area > 0.0 ? ramp(cell.contact_area / cell.area, from, to) : 1.0;
         };
       },
       .judge = &judge_rising});
}

std::shared_ptr<const ArrestFactor> by_field() {
  return make_factor(
      {.info = {.name = "arrest_by_field",
                .title = "Arrest by a field",
                .equation = "g = cⁿ/(c_hⁿ + cⁿ); with `inhibits` c_hⁿ/(c_hⁿ + cⁿ)",
                .source = "Hill 1910",
                .parameters = {given_by_study("half", "concentration", "mM", "c_h."), power_parameter()}},
       .section = {.name = "field",
                   .doc = "By the concentration of a field at the cell: a Hill function.",
                   .example = "{field: oxygen, half: 0.02 mM, power: 4}"},
       .keys = {{Kind::kField, {.name = "field", .doc = "Which field.", .required = true, .example = "oxygen"}},
                {Kind::kFieldValue, key("half", "Concentration at which half is left.", Quantity::kConcentration, 1e-12, 1e6, "0.02 mM")},
                {Kind::kQuantity, power_key()},
                {Kind::kFlag,
                 {.name = "inhibits",
                  .doc = "Whether much of it holds back, and not little.",
                  .fallback = "false",
                  .example = "true",
                  .source = "chosen"}}},
       .build = [](const OwnValues& values) -> ArrestOf {
         return [field = static_cast<std::size_t>(values("field")), half = values("half"), power = values("power"),
                 inhibits = values.flag("inhibits")](const CellView& cell) {
           const double there = hill(cell.concentration(field), half, power);
           return inhibits ? 1.0 - there : there;
         };
       }});
}

}  // namespace

double ramp(double value, double from, double to) { return std::clamp((to - value) / (to - from), 0.0, 1.0); }

double hill(double value, double half, double power) {
  if (!(value > 0.0)) return 0.0;
  const double x = std::pow(value / half, power);
  return std::isinf(x) ? 1.0 : x / (1.0 + x);
}

std::vector<std::shared_ptr<const ArrestFactor>> builtin_arrest_factors() {
  return {by_pressure(), by_pressure_hill(), by_volume(), by_contact(), by_field()};
}

}  // namespace morula
