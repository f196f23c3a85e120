#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/result.h"

namespace morula::scenarios {

/// The values of a resolved study by the paths of their keys, as texts: "cell_types.tumour.radius.mean" → "5 um"; items of lists by their numbers.
using Settings = std::map<std::string, std::string>;

/// Error: kFile, where the text is no YAML.
Result<Settings> settings_of(const std::string& resolved_text, const std::string& origin);

/// The paths at which any of them differ, in their order; where one has no such key its text is empty. `but`: paths that do not count.
std::vector<std::string> differing_paths(const std::vector<const Settings*>& all, const std::vector<std::string>& but);

/// The text at a path; empty where there is none.
[[nodiscard]] std::string setting(const Settings& settings, const std::string& path);

}  // namespace morula::scenarios
