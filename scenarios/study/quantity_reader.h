#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "scenarios/study/diagnostics.h"

namespace morula::scenarios {

/// What kind of number a key holds. A plain number carries no unit; all others must.
enum class Quantity : std::uint8_t {
  kNumber,            ///< no unit
  kFraction,          ///< 0.1 or 10 %
  kAngle,
  kLength,
  kTime,
  kSpeed,
  kPressure,
  kTension,           ///< surface tension, adhesion energy per area
  kEnergy,
  kFrictionPerArea,
  kFrictionPerNode,   ///< friction coefficient of one edge
  kRate,
  kConcentration,
  kDiffusion,
  kAmountRate,
  kPressurePerLength, ///< repulsion of surfaces
};

/// Name of the quantity for people, with its article: "a pressure".
std::string quantity_name(Quantity quantity);
/// The unit Morula computes in, as text: "kPa"; "" for plain numbers.
std::string internal_unit(Quantity quantity);

/// Read `text` as a number with a unit of this quantity, in internal units (µm, nN, s, amol). Errors E201–E205, E301, E304 name `key` and
/// give `example`; then the result is empty.
std::optional<double> read_quantity(std::string_view text, Quantity quantity, const std::string& key, const std::string& example,
                                    const Place& place, Diagnostics& diagnostics);

/// A plain decimal number at the start of `text` (sign, digits, point, exponent), and how many characters it takes; 0 when there is none.
/// `NaN`, `inf`, hexadecimal and a comma are no numbers.
struct ParsedNumber {
  double value = 0.0;
  std::size_t length = 0;
  bool octal_looking = false;  ///< a zero before another digit, as in 010
};
ParsedNumber parse_number(std::string_view text);
/// NaN, .nan, inf, -.Inf, infinity in any case.
bool is_not_finite_word(std::string_view text);

}  // namespace morula::scenarios
