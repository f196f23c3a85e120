#include "study/quantity_reader.h"

#include "core/numbers/decimal_number.h"

namespace morula::scenarios {
namespace {

int code_of(UnitError::Kind kind, Quantity quantity) {
  switch (kind) {
    case UnitError::Kind::kNoUnit:
      return 201;
    case UnitError::Kind::kUnknownUnit:
      return 202;
    case UnitError::Kind::kWrongDimension:
      return quantity == Quantity::kNumber ? 205 : 203;
    case UnitError::Kind::kNotANumber:
      return 204;
    case UnitError::Kind::kNotFinite:
      return 301;
  }
  return 204;
}

}  // namespace

std::optional<double> read_quantity(const UnitSystem& units, std::string_view text, Quantity quantity, const std::string& key,
                                    const std::string& example, const Place& place, Diagnostics& diagnostics) {
  const std::string name = "'" + key + "'";
  if (read_decimal_number(text).leading_zero) {
    diagnostics.error(304, place, name + " begins with a zero: '" + std::string(text) + "' could be meant as octal", "leave the zero away");
    return std::nullopt;
  }
  auto value = units.parse(text, quantity);
  if (value.ok()) return *value;
  const UnitError& error = value.error();
  diagnostics.error(code_of(error.kind, quantity), place, name + " " + error.message,
                    example.empty() ? error.help : "for example `" + example + "`");
  return std::nullopt;
}

}  // namespace morula::scenarios
