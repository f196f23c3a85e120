#include "coupling/cell_view.h"
#include "coupling/regions/outside_law.h"

namespace morula {
namespace {

std::vector<LawParameter> thresholds(const char* quantity, const char* unit) {
  return {given_by_study("promote", quantity, unit, "Beyond it a sphere becomes a shell."),
          given_by_study("demote", quantity, unit, "Beyond it, on the other side, a shell becomes a sphere.")};
}

}  // namespace

std::shared_ptr<const TriggerValue> pressure_value() {
  static const auto value =
      std::make_shared<const TriggerValue>(TriggerValue{.info = {.name = "pressure",
                                                                 .title = "Pressure of a cell, averaged over a minute",
                                                                 .equation = "p ← p + (1 − e^(−Δt/τ))(−tr σ/3 − p)",
                                                                 .source = "choice of this project",
                                                                 .parameters = thresholds("pressure", "kPa")},
                                                        .quantity = Quantity::kPressure,
                                                        .example = "pressure > 1 kPa",
                                                        .of = [](const Trigger&, const CellView& cell) { return cell.row().pressure; }});
  return value;
}

std::shared_ptr<const TriggerValue> field_value() {
  static const auto value = std::make_shared<const TriggerValue>(TriggerValue{
      .info = {.name = "field",
               .title = "Concentration of a field at the cell, by the field's name",
               .equation = "c",
               .source = "choice of this project",
               .parameters = thresholds("concentration", "mM")},
      .quantity = Quantity::kConcentration,
      .example = "oxygen < 0.05 mM",
      .awaited = "fields that cells answer to",
      .least = 0.0,
      .of = [](const Trigger& trigger, const CellView& cell) { return cell.concentration(static_cast<std::size_t>(trigger.field)); }});
  return value;
}

std::shared_ptr<const TriggerValue> outside_law_value() {
  static const auto value = std::make_shared<const TriggerValue>(
      TriggerValue{.info = {.name = "outside_law",
                            .title = "How far a cell is beyond the range of the laws of spheres: of its contacts, and of its packing",
                            .equation = "max(max_j A_ij/(π (0.45 R)²), φ_i/φ_max), of a fitted law δ_ij over the end of the fitted "
                                        "overlaps; 1: at the end of the range",
                            .source = "choice of this project; a/R ≲ 0.4: Johnson 1985, ch. 5",
                            .parameters = thresholds("number", "1")},
                   .quantity = Quantity::kNumber,
                   .example = "outside_law > 1",
                   .looks_at_body = true,
                   .least = 0.0,
                   .of = [](const Trigger&, const CellView& cell) { return cell.outside_law; }});
  return value;
}

namespace {

/// Contacts of spheres are told by laws of pairs, of which the areas may add up to more than a surface.
constexpr double kMostShare = 2.0;

/// The filter of the pressure lags a steady rise by its own time.
std::shared_ptr<const TriggerValue> pressure_rise_value() {
  static const auto value = std::make_shared<const TriggerValue>(
      TriggerValue{.info = {.name = "pressure_rise",
                            .title = "How much the pressure of a cell rises in a minute; a fall is below 0",
                            .equation = "−tr σ/3 − p, p as in `pressure`: τ dp/dt of a steady rise, τ = 1 min",
                            .source = "choice of this project",
                            .parameters = thresholds("pressure", "kPa")},
                   .quantity = Quantity::kPressure,
                   .example = "pressure_rise > 10 Pa",
                   .looks_at_body = true,
                   .of = [](const Trigger&, const CellView& cell) { return cell.pressure - cell.row().pressure; }});
  return value;
}

std::shared_ptr<const TriggerValue> packing_value() {
  static const auto value = std::make_shared<const TriggerValue>(
      TriggerValue{.info = {.name = "packing",
                            .title = "How tightly a cell is packed as a ball: the part of it behind the planes of its contacts",
                            .equation = "φ_i = Σ_j v_cap,ij/V_i",
                            .source = "choice of this project after Van Liedekerke et al. 2019, doi:10.1371/journal.pcbi.1006273",
                            .parameters = thresholds("fraction", "1")},
                   .quantity = Quantity::kFraction,
                   .example = "packing > 20 %",
                   .looks_at_body = true,
                   .least = 0.0,
                   .of = [](const Trigger&, const CellView& cell) { return cell.packing; }});
  return value;
}

std::shared_ptr<const TriggerValue> age_value() {
  static const auto value = std::make_shared<const TriggerValue>(
      TriggerValue{.info = {.name = "age",
                            .title = "Time since the birth of a cell; founders of a cycle are as old as their place in it says",
                            .equation = "t − t_birth",
                            .source = "choice of this project",
                            .parameters = thresholds("time", "h")},
                   .quantity = Quantity::kTime,
                   .example = "age > 2 h",
                   .awaited = "cells that grow old enough for a trigger",
                   .least = 0.0,
                   .of = [](const Trigger&, const CellView& cell) { return cell.age(); }});
  return value;
}

std::shared_ptr<const TriggerValue> contact_share_value() {
  static const auto value = std::make_shared<const TriggerValue>(TriggerValue{
      .info = {.name = "contact_share",
               .title = "Part of a cell's surface in contact with cells and obstacles: whether it lies within the tissue or at its border",
               .equation = "A_contact/A",
               .source = "choice of this project",
               .parameters = thresholds("number", "1")},
      .quantity = Quantity::kNumber,
      .example = "contact_share < 0.5",
      .looks_at_body = true,
      .least = 0.0,
      .most = kMostShare,
      .of = [](const Trigger&, const CellView& cell) { return cell.contact_area / cell.area; }});
  return value;
}

}  // namespace

std::vector<std::shared_ptr<const TriggerValue>> builtin_trigger_values() {
  return {pressure_value(), pressure_rise_value(), packing_value(), field_value(), outside_law_value(), age_value(), contact_share_value()};
}

}  // namespace morula
