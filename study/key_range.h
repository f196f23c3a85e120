#pragma once
#include <string>

#include "study/section.h"

namespace morula::scenarios {

/// The range of a key's values, in internal units: both ends are numbers, whatever the declaration leaves open.
struct KeyRange {
  double low = 0.0, high = 0.0;
  bool low_open = false, high_open = false;
  const char *low_reason = "", *high_reason = "";  ///< of an end that is the quantity's and not the key's own; else ""

  [[nodiscard]] bool holds(double x) const { return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high); }
  /// Why a value that it does not hold is refused, where the quantity says so: " (from ...)"; else "".
  [[nodiscard]] std::string reason_against(double x) const;
};

/// What the declaration says; where it has no end, that of the quantity: the smallest and the largest size that anything in or around a
/// tissue has, or that double precision bears. A value that must be above 0 is at least the quantity's smallest.
KeyRange range_of(const KeySpec& key);

/// The range in words: "between 1e-09 s and 3.2e+09 s"; "1" where it is one value, as the version of the file's format.
std::string range_words(const KeySpec& key);
/// What a key may be, in words: "one of both, high, low" or its range; empty for one that is no number with an end: a name, a direction, a flag.
std::string allowed_values(const KeySpec& key);

}  // namespace morula::scenarios
