#pragma once
#include "fields/reaction_loop.h"

namespace morula::fields {
/// λ c in the whole volume.
struct Decay {
  double rate;  // λ [1/s]

  double taken(double c) const noexcept { return rate * c; }
  double slope(double /*c*/) const noexcept { return rate; }
  double steepest(double /*highest*/) const noexcept { return rate; }
};

inline std::shared_ptr<const Reaction> decay() {
  static const auto reaction =
      make_reaction<Decay>({.info = {.name = "decay",
                                     .title = "Decay in the whole volume",
                                     .equation = "∂c/∂t = … − λ c",
                                     .source = "kinetics of first order",
                                     .parameters = {given_by_study("decay", "rate", "1/s", "λ.")}},
                            .section = {.name = "decay", .doc = "Decay in the whole volume.", .example = "0.1 1/h"},
                            .keys = {{OwnKey::Kind::kQuantity,
                                      {.name = "decay",
                                       .doc = "Rate of decay.",
                                       .quantity = Quantity::kRate,
                                       .fallback = "0 1/s",
                                       .low = 0.0,
                                       .example = "0.1 1/h",
                                       .source = "chosen"}}},
                            .where = Reaction::Where::kVolume,
                            .bare = true,
                            .first_order = true,
                            .coefficients = [](const LawValues& values) { return ReactionCoefficients{values("decay")}; },
                            .never_acts = [](const LawValues& values) { return values("decay") == 0.0; }});
  return reaction;
}

}  // namespace morula::fields
