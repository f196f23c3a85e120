#pragma once
#include <cstddef>
#include <string>

#include "core/numbers/number_text.h"
#include "scenarios/results/run_record.h"

namespace morula::scenarios {

inline std::string with_unit(double limit, const char* unit) { return number_text("%g", limit) + (*unit ? " " : "") + unit; }

inline Verdict at_most(const char* id, const char* quantity, double value, double limit, const char* unit = "") {
  return {id, quantity, value, "<= " + with_unit(limit, unit), value <= limit};
}

inline Verdict at_least(const char* id, const char* quantity, double value, double limit, const char* unit = "") {
  return {id, quantity, value, ">= " + with_unit(limit, unit), value >= limit};
}

inline Verdict within(const char* id, const char* quantity, double value, double low, double high) {
  return {id, quantity, value, number_text("%g", low) + " to " + number_text("%g", high), value >= low && value <= high};
}

inline Verdict equal(const char* id, const char* quantity, std::size_t value, std::size_t expected) {
  return {id, quantity, static_cast<double>(value), "== " + std::to_string(expected), value == expected};
}

}  // namespace morula::scenarios
