#pragma once
#include <cstdint>
#include <string>

#include "core/cell_id.h"

namespace morula {

enum class EventKind : std::uint8_t {
  kDivision,
  kDivisionWaits,  ///< a shell reached its division volume
  kDeath,
  kRemoval,
  kPromotion,
  kDemotion,
  kWarning,
};

/// Something that happened to a cell; written to events.jsonl, one line each, in the order of (time, kind, cell).
struct Event {
  double time = 0.0;
  EventKind kind{};
  CellId cell;
  CellId first_daughter, second_daughter;
  std::string text;  ///< the reason, for people
};

}  // namespace morula
