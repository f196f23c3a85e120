#include "core/numbers/unit_conversion.h"

#include <udunits2.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "core/numbers/decimal_number.h"
#include "core/numbers/number_text.h"
#include "core/numbers/unit_table.h"

namespace morula {
namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const noexcept { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

struct FreeSystem {
  void operator()(ut_system* system) const noexcept { ut_free_system(system); }
};

/// udunits2's parser, status and message handler are process-wide variables: no two calls at once, whichever object they come from.
std::mutex& udunits_lock() {
  static std::mutex lock;
  return lock;
}

/// A factor as a ratio, one part of which is 1: 3600/1 for hours, 1/100 for percent. Both parts are decimal numbers where there are such.
struct Factor {
  long double times = 1.0L;
  long double over = 1.0L;

  [[nodiscard]] long double internal(long double number) const { return number * times / over; }
  [[nodiscard]] long double in_unit(long double number) const { return number * over / times; }
};

/// The decimal number of at most 13 digits that a factor is but for rounding errors, if there is one.
std::optional<long double> nearby_decimal(double factor) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, factor, std::chars_format::scientific, 12).ptr;
  long double decimal = 0.0L;
  std::from_chars(text, end, decimal);
  // udunits2 multiplies and divides a few factors: 8 roundings of a double are allowed for
  if (std::abs(decimal - factor) <= 8 * std::numeric_limits<double>::epsilon() * std::abs(decimal)) return decimal;
  return std::nullopt;
}

Factor exact_factor(double factor) {
  if (const auto decimal = nearby_decimal(factor); decimal && *decimal >= 1.0L) return {*decimal, 1.0L};
  if (const auto decimal = nearby_decimal(1.0 / factor)) return {1.0L, *decimal};
  if (const auto decimal = nearby_decimal(factor)) return {*decimal, 1.0L};
  return {factor, 1.0L};
}

/// Characters beyond ASCII that people write in units, in the spelling that udunits2's tables have.
std::string plain_spelling(std::string_view unit) {
  static constexpr std::pair<std::string_view, std::string_view> kSpelling[] = {
      {"µ", "u"}, {"μ", "u"}, {"·", " "}, {"⋅", " "}, {"×", " "}, {"−", "-"}, {"\u00a0", " "}, {"\u202f", " "}, {"°", "deg"}};
  static constexpr std::pair<std::string_view, std::string_view> kSuperscripts[] = {{"⁻", "-"}, {"⁰", "0"}, {"¹", "1"}, {"²", "2"},
                                                                                    {"³", "3"}, {"⁴", "4"}, {"⁵", "5"}, {"⁶", "6"}};
  std::string out;
  bool raised = false;
  const auto take = [&](const auto& table, bool raises) {
    for (const auto& [from, to] : table) {
      if (!unit.starts_with(from)) continue;
      if (raises && !raised) out += '^';
      out += to;
      raised = raises;
      unit.remove_prefix(from.size());
      return true;
    }
    return false;
  };
  while (!unit.empty()) {
    if (take(kSuperscripts, true) || take(kSpelling, false)) continue;
    out += unit.front();
    raised = false;
    unit.remove_prefix(1);
  }
  return out;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/// A unit is written with letters, %, exponents, products and quotients. udunits2 reads more than that: numbers as factors ("3 um"),
/// origins ("s since ..", "K @ 273"), logarithms ("lg(re 1 mW)"); in a study such a thing is a slip of the pen.
bool is_plain_unit(std::string_view unit) {
  if (unit.starts_with("1/") || unit.starts_with("1 /")) unit.remove_prefix(1);
  char before = ' ';
  bool in_exponent = false;
  for (const char c : unit) {
    const bool digit = c >= '0' && c <= '9';
    const bool letter = std::isalpha(static_cast<unsigned char>(c)) || c == '%';
    if (digit) {
      const bool follows = std::isalpha(static_cast<unsigned char>(before)) || before == '^' || before == '-' || in_exponent;
      if (!follows) return false;
    } else if (!letter && std::string_view(" ^-*/.()").find(c) == std::string_view::npos) {
      return false;
    }
    in_exponent = digit;
    before = c;
  }
  return true;
}

std::string help_for(Quantity quantity) { return "for example `" + std::string(describe(quantity).example) + "`"; }

}  // namespace

class UnitSystem::Implementation {
 public:
  Implementation() {
    const std::lock_guard guard(udunits_lock());
    ut_set_error_message_handler(ut_ignore);
    system_.reset(ut_new_system());
    for (const char* base : {"um", "g", "s", "amol", "rad", "K"}) map(Unit(ut_new_base_unit(system_.get())), base, "");
    map(read("g"), "", "gram");
    map(read("s"), "", "second");
    map(read("rad"), "", "radian");
    for (const UnitPrefix& prefix : unit_prefixes()) {
      ut_add_symbol_prefix(system_.get(), std::string(prefix.symbol).c_str(), prefix.factor);
      ut_add_name_prefix(system_.get(), std::string(prefix.name).c_str(), prefix.factor);
    }
    for (const UnitDefinition& unit : unit_definitions()) map(read(unit.definition), unit.symbol, unit.name);
  }

  /// Factor from this unit to the quantity's internal unit, or what is wrong with it.
  [[nodiscard]] Result<Factor, UnitError> factor(std::string_view text, Quantity quantity) const {
    const std::string unit = std::string(trimmed(text));
    const std::string name(describe(quantity).name);
    if (quantity == Quantity::kNumber)
      return UnitError{UnitError::Kind::kWrongDimension, "is a plain number, but has the unit '" + unit + "'", help_for(quantity)};
    std::string spelled = plain_spelling(unit);
    if (spelled.starts_with('/')) spelled.insert(0, "1");
    const std::lock_guard guard(udunits_lock());
    const Unit from = is_plain_unit(spelled) ? read(spelled) : nullptr;
    if (!from) return UnitError{UnitError::Kind::kUnknownUnit, "has an unknown unit '" + unit + "'", help_for(quantity)};
    if (const auto ratio = ratio_to(*from, written_units(quantity).internal)) return exact_factor(*ratio);
    return UnitError{UnitError::Kind::kWrongDimension, "is " + name + ", but '" + unit + "' is " + words_for(*from), help_for(quantity)};
  }

 private:
  void map(Unit unit, std::string_view symbol, std::string_view name) {
    if (!symbol.empty()) ut_map_symbol_to_unit(std::string(symbol).c_str(), UT_UTF8, unit.get());
    if (!name.empty()) {
      ut_map_name_to_unit(std::string(name).c_str(), UT_UTF8, unit.get());
      ut_map_name_to_unit((std::string(name) + "s").c_str(), UT_UTF8, unit.get());
    }
  }
  [[nodiscard]] Unit read(std::string_view text) const { return Unit(ut_parse(system_.get(), std::string(text).c_str(), UT_UTF8)); }

  [[nodiscard]] std::optional<double> ratio_to(ut_unit& from, std::string_view to_text) const {
    const Unit to = read(to_text);
    if (!ut_are_convertible(&from, to.get()) || is_reciprocal(from, *to)) return std::nullopt;
    const std::unique_ptr<cv_converter, decltype(&cv_free)> converter(ut_get_converter(&from, to.get()), &cv_free);
    if (!converter) return std::nullopt;
    return cv_convert_double(converter.get(), 1.0);
  }

  /// udunits2 calls a unit and its reciprocal convertible ("s" and "1/s"); here a time is no rate.
  static bool is_reciprocal(ut_unit& from, ut_unit& to) {
    const Unit product(ut_multiply(&from, &to));
    const Unit dimensionless(ut_get_dimensionless_unit_one(ut_get_system(&from)));
    const Unit quotient(ut_divide(&from, &to));
    return ut_are_convertible(product.get(), dimensionless.get()) && !ut_are_convertible(quotient.get(), dimensionless.get());
  }

  [[nodiscard]] std::string words_for(ut_unit& unit) const {
    for (int q = static_cast<int>(Quantity::kFraction); q < kQuantityCount; ++q) {
      const auto quantity = static_cast<Quantity>(q);
      if (ratio_to(unit, written_units(quantity).internal)) return std::string(describe(quantity).name);
    }
    for (const OtherDimension& other : other_dimensions())
      if (ratio_to(unit, other.unit)) return std::string(other.name);
    return "a unit of something else";
  }

  std::unique_ptr<ut_system, FreeSystem> system_;
};

UnitSystem::UnitSystem() : implementation_(std::make_unique<Implementation>()) {}
UnitSystem::~UnitSystem() = default;
UnitSystem::UnitSystem(UnitSystem&&) noexcept = default;
UnitSystem& UnitSystem::operator=(UnitSystem&&) noexcept = default;

Result<double, UnitError> UnitSystem::parse(std::string_view text, Quantity quantity) const {
  using Kind = UnitError::Kind;
  text = trimmed(text);
  const std::string shown = "'" + std::string(text) + "'";
  const auto fail = [&](Kind kind, std::string message) { return UnitError{kind, std::move(message), help_for(quantity)}; };
  if (is_not_finite_word(text.substr(0, text.find(' ')))) return fail(Kind::kNotFinite, "is not a finite number: " + shown);
  const DecimalNumber number = read_decimal_number(text);
  if (number.length == 0)
    return fail(Kind::kNotANumber, "must be " + std::string(describe(quantity).name) + ", but " + shown + " does not begin with a number");
  if (number.leading_zero) return fail(Kind::kNotANumber, "begins with a zero: " + shown + " could be meant as octal");
  const std::string_view unit = trimmed(text.substr(number.length));
  const bool more_numbers = !unit.empty() && std::string_view("0123456789.,+-:_").find(unit.front()) != std::string_view::npos;
  if (more_numbers && !unit.starts_with("1/")) return fail(Kind::kNotANumber, shown + " is not one number with a unit");
  Factor factor;
  if (!unit.empty()) {
    auto found = implementation_->factor(unit, quantity);
    if (!found.ok()) return std::move(found).error();
    factor = found.value();
  } else if (quantity != Quantity::kNumber && quantity != Quantity::kFraction) {
    return fail(Kind::kNoUnit, "is " + std::string(describe(quantity).name) + " and needs a unit, but is " + shown);
  }
  const double value = static_cast<double>(factor.internal(number.value));
  if (!std::isfinite(value)) return fail(Kind::kNotFinite, "is too large for a number: " + shown);
  return value;
}

Result<double, UnitError> UnitSystem::factor(std::string_view unit, Quantity quantity) const {
  if (trimmed(unit).empty()) {
    if (quantity == Quantity::kNumber || quantity == Quantity::kFraction) return 1.0;
    return UnitError{UnitError::Kind::kNoUnit, "is " + std::string(describe(quantity).name) + " and needs a unit", help_for(quantity)};
  }
  auto found = implementation_->factor(unit, quantity);
  if (!found.ok()) return std::move(found).error();
  return static_cast<double>(found.value().internal(1.0L));
}

std::string UnitSystem::format_value(double internal, Quantity quantity) const {
  if (std::isnan(internal)) return "nan";
  if (std::isinf(internal)) return internal < 0 ? "-inf" : "inf";
  const auto internal_unit = describe(quantity).internal_unit;
  const std::string plain = shortest_text(internal) + (internal_unit.empty() ? "" : " ") + std::string(internal_unit);
  std::string best = plain;
  if (internal == 0.0) return best;
  for (const std::string_view unit : written_units(quantity).units) {
    if (unit.empty()) break;
    const auto factor = implementation_->factor(unit, quantity);
    const long double number = factor.value().in_unit(internal);
    const int whole_digits = std::abs(number) < 1.0L || std::abs(number) >= 1e6L ? 1 : static_cast<int>(std::log10(std::abs(number))) + 1;
    for (int digits = whole_digits; digits <= 18; ++digits) {
      char text[48];
      std::string written(text, std::to_chars(text, text + sizeof text, number, std::chars_format::general, digits).ptr);
      written += " " + std::string(unit);
      const auto back = parse(written, quantity);
      if (!back.ok() || back.value() != internal) continue;
      if (std::abs(number) >= 1.0L && std::abs(number) < 1e5L) return written;
      if (written.size() < best.size()) best = written;
      break;
    }
  }
  return best;
}

std::string UnitSystem::known_units() {
  std::string out = "um, g, s, amol, rad, K";
  for (const UnitDefinition& unit : unit_definitions())
    if (!unit.symbol.empty()) out += ", " + std::string(unit.symbol);
  return out;
}

}  // namespace morula
