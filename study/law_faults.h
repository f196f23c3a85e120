#pragma once
#include <string>
#include <vector>

#include "coupling/laws.h"

namespace morula::scenarios {

/// What is wrong with laws that a program brings, in the order of the kinds: two of one name, as "two of `loads` are called `trap`", of which a study
/// could not say which it means; a null pointer in a list; a law without a function that it must have; an observable whose name no column of
/// series.csv can have.
std::vector<std::string> law_faults(const Laws& laws);

}  // namespace morula::scenarios
