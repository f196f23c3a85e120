#pragma once
#include <array>
#include <span>
#include <string_view>

#include "core/numbers/unit_conversion.h"

namespace morula {

/// One unit by its symbol and, where people spell it out, its name; `definition` in units that stand above it.
struct UnitDefinition {
  std::string_view symbol;
  std::string_view name;
  std::string_view definition;
};
/// All units but the base units um, g, s, amol, rad, K, in an order in which each is defined before it is used.
std::span<const UnitDefinition> unit_definitions();

struct UnitPrefix {
  std::string_view symbol;
  std::string_view name;
  double factor;
};
std::span<const UnitPrefix> unit_prefixes();

/// How numbers of a quantity are written: units from the largest to the smallest; the first that gives a number of at least 1 is taken.
struct WrittenUnits {
  std::string_view internal;  ///< the internal unit in base units, as udunits2 reads it
  std::array<std::string_view, 5> units;
};
const WrittenUnits& written_units(Quantity quantity);

/// A dimension that no Quantity has, in words; for messages only.
struct OtherDimension {
  std::string_view unit;
  std::string_view name;
};
std::span<const OtherDimension> other_dimensions();

}  // namespace morula
