#pragma once
#include "fields/reaction_loop.h"
#include "fields/reactions/dying_part.h"

namespace morula::fields {
/// What one cell takes at concentration c [amol/s]: V_max c/(K_m + c) (Michaelis & Menten 1913; physics: fields_and_coupling.md, A).
/// Below 0, where a concentration only comes by the error of the time integration, the tangent V_max c/K_m goes on: the cell then
/// gives back, the amounts stay balanced, and the concentration is drawn back to 0.
struct MichaelisMenten {
  double rate;             // V_max [amol/s]
  double half_saturation;  // K_m [mM]

  double taken(double c) const noexcept { return c >= 0.0 ? rate * c / (half_saturation + c) : rate * c / half_saturation; }
  double slope(double c) const noexcept {
    const double k = half_saturation;
    return c >= 0.0 ? rate * k / ((k + c) * (k + c)) : rate / k;
  }
  double steepest(double /*highest*/) const noexcept { return slope(0.0); }
};

inline std::shared_ptr<const Reaction> uptake() {
  static const auto reaction = make_reaction<MichaelisMenten>(
      {.info = {.name = "uptake",
                .title = "Uptake by one cell",
                .equation = "V_max c/(K_m + c)",
                .source = "Michaelis & Menten 1913",
                .parameters = {given_by_study("rate", "amount rate", "amol/s", "V_max."),
                               given_by_study("half_saturation", "concentration", "mM", "K_m."),
                               given_by_study("dying", "number", "1", "Part of V_max that a dying cell has.")}},
       .section = {.name = "uptake",
                   .doc = "Uptake by cell type: a rate, or rate and half saturation.",
                   .shorthand = "rate",
                   .example = "{hepatocyte: 40 amol/s}"},
       .keys = {{OwnKey::Kind::kQuantity,
                 {.name = "rate",
                  .doc = "Uptake of one cell at plenty.",
                  .quantity = Quantity::kAmountRate,
                  .required = true,
                  .low = 0.0,
                  .example = "40 amol/s"}},
                {OwnKey::Kind::kQuantity,
                 {.name = "half_saturation",
                  .doc = "Concentration at which the uptake is half of that (Michaelis-Menten). A "
                         "millionth of what there is takes the full rate to the end.",
                  .quantity = Quantity::kConcentration,
                  .fallback = "0.005 mM",
                  .low = 1e-8,
                  .example = "0.005 mM",
                  .source = "chosen: order of oxygen uptake of mammalian cells"}},
                dying_part()},
       .where = Reaction::Where::kCells,
       .coefficients =
           [](const LawValues& values) {
             return ReactionCoefficients{values("rate"), values("half_saturation")};
           },
       .of_dying = with_part_of_dying,
       .never_acts = [](const LawValues& values) { return values("rate") == 0.0; }});
  return reaction;
}

}  // namespace morula::fields
