#pragma once
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/numbers/unit_conversion.h"

namespace morula {

/// A word that may stand where a number is due, and the number it stands for.
struct Special {
  const char* word;
  double value;
};

/// What `auto` stands for: a value that follows from others.
inline constexpr double kAuto = -1.0;

/// A key of the study, declared once: reader, checker, JSON Schema, `explain`, the resolved study, the reference and the reference of laws
/// follow from it. Laws declare their keys beside their formulas; everything else is declared in the study reader.
struct KeySpec {
  const char* name = "";
  std::string doc{};
  Quantity quantity = Quantity::kNumber;
  const char* fallback = nullptr;  ///< default as one would write it; nullptr: none
  bool required = false;
  bool optional_section = false;                          ///< of a section: its absence has a meaning, and its defaults hold only within it
  bool not_empty = false;                                 ///< of a list: one that is given has entries
  double low = -std::numeric_limits<double>::infinity();  ///< in internal units
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;                     ///< the limit itself is not allowed
  std::vector<Special> specials{};                              ///< words allowed instead of a number
  std::vector<std::string> words{};                             ///< the allowed words
  std::vector<std::pair<const char*, const char*>> synonyms{};  ///< (other spelling, word it stands for)
  const char* shorthand = nullptr;                              ///< for a section: the key that a bare value stands for
  const char* example = "";
  const char* source = "";  ///< where the default comes from

  /// Whether a number is within the limits.
  [[nodiscard]] bool holds(double x) const { return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high); }
};

}  // namespace morula
