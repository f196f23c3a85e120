#pragma once
#include <string>
#include <vector>

#include "core/result.h"
#include "coupling/observables/observable.h"

namespace morula::scenarios {

/// The observables with these names, in that order; all of them where none is named. kInput for a name that is not there.
Result<std::vector<Observable>> select_observables(const Model& model, const Laws& laws, const std::vector<std::string>& names);

}  // namespace morula::scenarios
