#pragma once
#include <optional>
#include <string>
#include <vector>

namespace morula::scenarios {

/// Names of all laws of spheres and shells, in the order of the documentation.
std::vector<std::string> law_names();
/// What a law is: title, equation, source, and its parameters with unit, range, default. Empty when there is no such law.
std::optional<std::string> explain_law(const std::string& name);

}  // namespace morula::scenarios
