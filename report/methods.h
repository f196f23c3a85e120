#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/law_info.h"

namespace morula::scenarios {

/// A law as a run used it.
struct UsedLaw {
  std::string purpose;  ///< "contact of spheres", "cortex of hepatocyte"; laws of one purpose stand together
  LawInfo law;
  /// Values by parameter name in the parameter's unit, of the model itself: what the study gave, its default, or what follows from these.
  std::vector<std::pair<std::string, double>> values;
};

/// One parameter with the value that was used: "5.0e-05", or "not set": the default of a law never stands for a value of the model.
std::string used_value(const UsedLaw& use, const LawParameter& parameter);

/// methods.md: every law with equation, source and a table of its parameters, ready to be pasted into a paper; then the study as it was resolved
/// (`resolved`: study.resolved.yaml), which says of each value whether the study gave it or it is a default, and where that comes from.
std::string methods_text(const std::string& title, std::span<const UsedLaw> laws, const std::string& resolved);

}  // namespace morula::scenarios
