#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "core/numbers/unit_conversion.h"
#include "study/diagnostics.h"

namespace morula::scenarios {

/// Read `text` as a number with a unit of this quantity, in internal units (µm, nN, s, amol). Errors E201–E205, E301 and E304 name `key`
/// and give `example` (or one of the quantity); then the result is empty.
std::optional<double> read_quantity(const UnitSystem& units, std::string_view text, Quantity quantity, const std::string& key,
                                    const std::string& example, const Place& place, Diagnostics& diagnostics);

}  // namespace morula::scenarios
