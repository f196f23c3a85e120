#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {

/// Numbers that are verified together: `morula verify NAME`.
struct VerifySuite {
  std::string_view name;
  std::string_view what;  ///< for people, in the list of suites
  std::vector<ReferenceNumber> (*numbers)();
  bool takes_minutes = false;  ///< its test has the label `slow`
};

/// All suites, the default first.
std::span<const VerifySuite> verify_suites();
/// None of this name: null.
const VerifySuite* find_suite(std::string_view name);

}  // namespace morula::scenarios
