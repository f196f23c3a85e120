#include "core/numbers/decimal_number.h"

#include <cctype>
#include <charconv>
#include <limits>
#include <string>

namespace morula {
namespace {

bool is_digit(std::string_view text, std::size_t at) { return at < text.size() && text[at] >= '0' && text[at] <= '9'; }

std::size_t digits_from(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (is_digit(text, end)) ++end;
  return end - at;
}

}  // namespace

DecimalNumber read_decimal_number(std::string_view text) {
  DecimalNumber out;
  const bool sign = !text.empty() && (text[0] == '+' || text[0] == '-');
  std::size_t at = sign ? 1 : 0;
  const std::size_t whole = digits_from(text, at);
  out.leading_zero = whole > 1 && text[at] == '0';
  at += whole;
  std::size_t fraction = 0;
  if (at < text.size() && text[at] == '.') {
    fraction = digits_from(text, at + 1);
    if (whole + fraction > 0) at += 1 + fraction;
  }
  if (whole + fraction == 0) return {};
  bool tiny = false;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    const std::size_t digits = digits_from(text, exponent);
    if (digits > 0) {
      tiny = text[exponent - 1] == '-';
      at = exponent + digits;
    }
  }
  out.length = at;
  const char* const begin = text.data() + (text[0] == '+' ? 1 : 0);  // from_chars takes no plus
  if (std::from_chars(begin, text.data() + at, out.value).ec == std::errc::result_out_of_range)
    out.value = (text[0] == '-' ? -1.0L : 1.0L) * (tiny ? 0.0L : std::numeric_limits<long double>::infinity());
  return out;
}

bool is_not_finite_word(std::string_view text) {
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
  if (!text.empty() && text[0] == '.') text.remove_prefix(1);
  std::string lower;
  for (const char c : text) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

}  // namespace morula
