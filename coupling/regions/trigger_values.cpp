#include "coupling/cell_view.h"
#include "coupling/regions/region.h"

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
      .of = [](const Trigger& trigger, const CellView& cell) { return cell.concentration(static_cast<std::size_t>(trigger.field)); }});
  return value;
}

std::vector<std::shared_ptr<const TriggerValue>> builtin_trigger_values() { return {pressure_value(), field_value()}; }

}  // namespace morula
