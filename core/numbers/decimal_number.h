#pragma once
#include <cstddef>
#include <string_view>

namespace morula {

/// A decimal number at the start of a text.
struct DecimalNumber {
  long double value = 0.0L;
  std::size_t length = 0;     ///< characters it takes; 0: the text does not begin with a number
  bool leading_zero = false;  ///< as in 010, which some readers take for octal
};

/// Sign, digits, point, exponent: nothing else (no NaN, no infinity, no hexadecimal, no comma), whatever the locale.
/// Beyond the range of long double the value is infinite or 0.
DecimalNumber read_decimal_number(std::string_view text);

/// "NaN", ".nan", "inf", "-.Inf", "infinity" in any case: the words that YAML and C take for numbers that are not finite.
bool is_not_finite_word(std::string_view text);

}  // namespace morula
