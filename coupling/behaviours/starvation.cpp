#include "coupling/behaviours/behaviour.h"
#include "coupling/cell_view.h"

namespace morula {
namespace {

Behave starve(const OwnValues& values) {
  return [field = static_cast<std::size_t>(values.number("field")), below = values("below"), rate = values("rate")](const CellStep& step,
                                                                                                                    CellWish& wish) {
    if (rate > 0.0 && step.cell.concentration(field) < below && step.happens(rate)) wish.die = true;
  };
}

}  // namespace

std::shared_ptr<const Behaviour> starvation() {
  using Kind = OwnKey::Kind;
  static const auto behaviour = std::make_shared<const Behaviour>(Behaviour{
      .info = {.name = "starvation",
               .title = "Death by lack of a concentration",
               .equation = "P(death in Δt) = 1 − e^(−rate·Δt) while c < below",
               .source = "choice of this project",
               .parameters = {given_by_study("below", "concentration", "mM", "Concentration below which cells may die."),
                              given_by_study("rate", "rate", "1/s", "Probability of death per time while below.")}},
      .section = {.name = "death",
                  .doc = "Death by lack of a field: while the concentration is below a threshold, cells die at a rate.",
                  .optional_section = true,
                  .example = "{oxygen_below: 0.02 mM, rate: 0.05 1/h}"},
      .keys = {{Kind::kField, {.name = "field", .doc = "The field whose lack kills.", .required = true, .example = "oxygen"}},
               {Kind::kFieldValue,
                {.name = "below",
                 .doc = "Concentration below which cells die.",
                 .quantity = Quantity::kConcentration,
                 .required = true,
                 .low = 0.0,
                 .example = "0.02 mM"}},
               {Kind::kQuantity,
                {.name = "rate",
                 .doc = "Probability of death per time while below.",
                 .quantity = Quantity::kRate,
                 .required = true,
                 .low = 0.0,
                 .example = "0.05 1/h"}}},
      .stream = RandomStream::kDeath,
      .build = &starve,
      .reason = [](const OwnValues& values, const std::string& type) { return values.name("field") + " is below what " + type + " needs"; },
      .never_acts = [](const OwnValues& values) { return !(values("rate") > 0.0); },
      .awaited = "fields that cells answer to"});
  return behaviour;
}

}  // namespace morula
