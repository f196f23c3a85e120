#include "scenarios/study/quantity_reader.h"

#include <udunits2.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "scenarios/study/read_section.h"

namespace morula::scenarios {
namespace {

struct QuantityInfo {
  const char* name;
  const char* unit;   ///< internal, as udunits2 writes it
  const char* shown;  ///< internal, for people
};

const QuantityInfo& info(Quantity quantity) {
  static constexpr QuantityInfo kInfo[] = {
      {"a plain number", "1", ""},
      {"a fraction", "1", ""},
      {"an angle", "radian", "rad"},
      {"a length", "um", "um"},
      {"a time", "s", "s"},
      {"a speed", "um/s", "um/s"},
      {"a pressure", "nN/um^2", "kPa"},
      {"a surface energy or tension", "nN/um", "nN/um"},
      {"an energy", "nN um", "fJ"},
      {"a friction per area", "nN s/um^3", "nN s/um^3"},
      {"a friction coefficient", "nN s/um", "nN s/um"},
      {"a rate", "1/s", "1/s"},
      {"a concentration", "amol/um^3", "mM"},
      {"a diffusion coefficient", "um^2/s", "um^2/s"},
      {"an amount per time", "amol/s", "amol/s"},
      {"a pressure per length", "nN/um^3", "kPa/um"},
  };
  return kInfo[static_cast<std::size_t>(quantity)];
}

class Units {
 public:
  Units() {
    ut_set_error_message_handler(ut_ignore);
    system_ = ut_read_xml(nullptr);
    // molar and its prefixes are not in the database
    ut_unit* molar = ut_parse(system_, "mol/dm^3", UT_UTF8);
    ut_map_name_to_unit("M", UT_UTF8, molar);
    ut_map_symbol_to_unit("M", UT_UTF8, molar);
  }
  ut_unit* parse(const std::string& text) const { return ut_parse(system_, text.c_str(), UT_UTF8); }

 private:
  ut_system* system_;
};

const Units& units() {
  static const Units kUnits;
  return kUnits;
}

std::optional<double> factor(const std::string& unit, Quantity quantity) {
  ut_unit* from = units().parse(unit);
  ut_unit* to = units().parse(info(quantity).unit);
  std::optional<double> result;
  if (from && to && ut_are_convertible(from, to)) {
    cv_converter* converter = ut_get_converter(from, to);
    result = cv_convert_double(converter, 1.0);
    cv_free(converter);
  }
  ut_free(from);
  ut_free(to);
  return result;
}

}  // namespace

std::string quantity_name(Quantity quantity) { return info(quantity).name; }
std::string internal_unit(Quantity quantity) { return info(quantity).shown; }

ParsedNumber parse_number(std::string_view text) {
  ParsedNumber result;
  std::size_t i = 0;
  const auto digit = [&](std::size_t at) { return at < text.size() && text[at] >= '0' && text[at] <= '9'; };
  if (i < text.size() && (text[i] == '+' || text[i] == '-')) ++i;
  const std::size_t number = i;
  while (digit(i)) ++i;
  const std::size_t whole_digits = i - number;
  std::size_t fraction_digits = 0;
  if (i < text.size() && text[i] == '.') {
    std::size_t j = i + 1;
    while (digit(j)) ++j, ++fraction_digits;
    if (whole_digits + fraction_digits > 0) i = j;
  }
  if (whole_digits + fraction_digits == 0) return result;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    std::size_t j = i + 1;
    if (j < text.size() && (text[j] == '+' || text[j] == '-')) ++j;
    if (digit(j)) {
      while (digit(j)) ++j;
      i = j;
    }
  }
  result.octal_looking = whole_digits > 1 && text[number] == '0';
  const std::size_t begin = text[0] == '+' ? 1 : 0;
  const auto [end, code] = std::from_chars(text.data() + begin, text.data() + i, result.value);
  if (code == std::errc::result_out_of_range) {
    const std::size_t e = text.substr(0, i).find_first_of("eE");
    const bool tiny = e != std::string_view::npos && e + 1 < i && text[e + 1] == '-';
    result.value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  result.length = i;
  return result;
}

bool is_not_finite_word(std::string_view text) {
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
  if (!text.empty() && text[0] == '.') text.remove_prefix(1);
  std::string lower;
  for (const char c : text) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

std::optional<double> read_quantity(std::string_view text, Quantity quantity, const std::string& key, const std::string& example,
                                    const Place& place, Diagnostics& diagnostics) {
  const std::string name = "'" + key + "'", shown = "'" + std::string(text) + "'";
  const std::string help = example.empty() ? "" : "for example `" + example + "`";
  const auto fail = [&](int code, const std::string& what, const std::string& better) {
    diagnostics.error(code, place, what, better);
    return std::nullopt;
  };
  const std::string_view first_word = text.substr(0, text.find(' '));
  if (is_not_finite_word(first_word)) return fail(301, name + " is not a finite number: " + shown, help);
  const ParsedNumber number = parse_number(text);
  if (number.length == 0) return fail(204, name + " must be " + quantity_name(quantity) + ", but " + shown + " does not begin with a number", help);
  if (!std::isfinite(number.value)) return fail(301, name + " is too large for a number: " + shown, help);
  if (number.octal_looking) return fail(304, name + " begins with a zero: " + shown + " could be meant as octal", "leave the zero away");

  std::string_view unit = text.substr(number.length);
  while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
  if (unit.empty()) {
    if (quantity == Quantity::kNumber || quantity == Quantity::kFraction) return number.value;
    return fail(201, name + " is " + quantity_name(quantity) + " and needs a unit, but is " + shown, help);
  }
  const char next = unit.front();
  if ((next >= '0' && next <= '9') || next == '.' || next == ',' || next == '+' || next == '-')
    return fail(204, name + " is not a number with a unit: " + shown, help.empty() ? "write one number, then its unit" : help);
  if (quantity == Quantity::kNumber) return fail(205, name + " is a plain number, but " + shown + " has a unit", help);
  const std::string unit_text(unit);
  if (const auto per_unit = factor(unit_text, quantity)) {
    const double value = number.value * *per_unit;
    if (!std::isfinite(value)) return fail(301, name + " is too large for a number: " + shown, help);
    return value;
  }
  ut_unit* known = units().parse(unit_text);
  ut_free(known);
  if (!known) return fail(202, name + " has an unknown unit '" + unit_text + "'", help);
  std::string what = "a unit of something else";
  for (int q = static_cast<int>(Quantity::kFraction); q <= static_cast<int>(Quantity::kPressurePerLength); ++q)
    if (factor(unit_text, static_cast<Quantity>(q))) {
      what = quantity_name(static_cast<Quantity>(q));
      break;
    }
  return fail(203, name + " is " + quantity_name(quantity) + ", but '" + unit_text + "' is " + what, help);
}

}  // namespace morula::scenarios
