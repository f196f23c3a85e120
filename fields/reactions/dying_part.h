#pragma once
#include "core/own_keys.h"
#include "fields/reaction.h"

namespace morula::fields {

/// The key that says how much of a reaction's `rate` a cell has that is dying.
inline OwnKey dying_part() {
  return {OwnKey::Kind::kQuantity,
          {.name = "dying",
           .doc = "Rate of a cell that is dying and shrinks, as a part of that of a living one.",
           .quantity = Quantity::kFraction,
           .fallback = "0 %",
           .low = 0.0,
           .high = 1.0,
           .example = "100 %",
           .source = "chosen: a dead cell has no metabolism"}};
}

inline LawValues with_part_of_dying(const LawValues& values) {
  LawValues out = values;
  out.set("rate", values("dying") * values("rate"));
  return out;
}

}  // namespace morula::fields
