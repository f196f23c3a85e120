#pragma once
#include <string_view>
#include <vector>

#include "dcm/shell_law.h"

namespace morula::dcm {

/// The laws that Morula brings, in the order of the documentation. Tests, the study reader, `explain`, docs/laws.md and `methods.md` walk this
/// list, or one that a program has appended its own laws to.
const std::vector<ShellLaw>& shell_laws();

/// One of them by its name, which must be right.
const ShellLaw& shell_law(std::string_view name);

}  // namespace morula::dcm
