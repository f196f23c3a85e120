#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/law_info.h"
#include "core/result.h"

namespace morula::scenarios {

/// A law as a run used it.
struct UsedLaw {
  std::string purpose;  ///< "contact of spheres", "cortex of hepatocyte"; laws of one purpose stand together
  LawInfo law;
  /// Values by parameter name in the parameter's unit; a parameter that is not named had its fallback.
  std::vector<std::pair<std::string, double>> values;
};

/// One parameter with the value that was used: "5.0e-05", or "not set".
std::string used_value(const UsedLaw& use, const LawParameter& parameter);

/// methods.md: every law with equation, source and a table of its parameters, ready to be pasted into a paper.
std::string methods_text(const std::string& title, std::span<const UsedLaw> laws);

/// methods_text to a file.
Status write_methods(const std::string& title, std::span<const UsedLaw> laws, const std::filesystem::path& path);

}  // namespace morula::scenarios
