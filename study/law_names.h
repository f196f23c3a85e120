#pragma once
#include <string>
#include <vector>

#include "coupling/laws.h"

namespace morula::scenarios {

/// What two laws of one kind are both called, as "loads: `trap`", in the order of the kinds: a study could not say which of them it means.
std::vector<std::string> names_twice(const Laws& laws);

}  // namespace morula::scenarios
