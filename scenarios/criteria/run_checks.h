#pragma once
#include <span>
#include <string_view>

namespace morula::scenarios {

/// What every run is asked for, whatever its study shows: the rows of `verdict.json` that no criterion of the study made.
struct RunCheck {
  const char* id;        ///< "INV.4"
  const char* quantity;  ///< as the verdict names it
  const char* limit;     ///< key of the study, or the number where there is none
  const char* doc;       ///< how it is measured, and what to do where it fails
};

std::span<const RunCheck> run_checks();
/// What is known of an id of run_checks(), which it must be.
const RunCheck& run_check(std::string_view id);

/// Largest rise of the energy between two outputs over its range (INV.7).
inline constexpr double kMostEnergyRise = 1e-3;

}  // namespace morula::scenarios
