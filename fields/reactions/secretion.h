#pragma once
#include "fields/reaction_loop.h"
#include "fields/reactions/dying_part.h"

namespace morula::fields {
/// What one cell makes at concentration c [amol/s]: S K/(K + c), less where there is much of it already (a product that inhibits its own making: Hill 1910 of
/// first order). Below 0, where a concentration only comes by the error of the time integration, it makes S. What a cell makes is a negative amount taken.
struct Secretion {
  double rate;             // S [amol/s]
  double half_inhibition;  // K [mM]

  double taken(double c) const noexcept { return c >= 0.0 ? -rate * half_inhibition / (half_inhibition + c) : -rate; }
  double slope(double c) const noexcept {
    const double k = half_inhibition;
    return c >= 0.0 ? rate * k / ((k + c) * (k + c)) : 0.0;
  }
  double steepest(double /*highest*/) const noexcept { return rate / half_inhibition; }
};

inline std::shared_ptr<const Reaction> secretion() {
  static const auto reaction = make_reaction<Secretion>(
      {.info = {.name = "secretion",
                .title = "Secretion by one cell",
                .equation = "−S K/(K + c)",
                .source = "Hill 1910, of first order, as inhibition",
                .parameters = {given_by_study("rate", "amount rate", "amol/s", "S."),
                               given_by_study("half_inhibition", "concentration", "mM", "K."),
                               given_by_study("dying", "number", "1", "Part of S that a dying cell has.")}},
       .section = {.name = "secretion",
                   .doc = "What cells give to the field, by cell type: a rate, or rate and half inhibition.",
                   .shorthand = "rate",
                   .example = "{hepatocyte: 10 amol/s}"},
       .keys = {{OwnKey::Kind::kQuantity,
                 {.name = "rate",
                  .doc = "What one cell makes where there is none of it.",
                  .quantity = Quantity::kAmountRate,
                  .required = true,
                  .low = 0.0,
                  .example = "10 amol/s"}},
                {OwnKey::Kind::kQuantity,
                 {.name = "half_inhibition",
                  .doc = "Concentration at which it makes half of that. The usual value, that of water in water, makes the rate constant.",
                  .quantity = Quantity::kConcentration,
                  .fallback = "56 M",
                  .low = 0.0,
                  .low_open = true,
                  .example = "0.1 mM",
                  .source = "chosen: no inhibition"}},
                dying_part()},
       .where = Reaction::Where::kCells,
       .coefficients =
           [](const LawValues& values) {
             return ReactionCoefficients{values("rate"), values("half_inhibition")};
           },
       .of_dying = with_part_of_dying,
       .never_acts = [](const LawValues& values) { return values("rate") == 0.0; }});
  return reaction;
}

}  // namespace morula::fields
