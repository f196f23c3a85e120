#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/verbs.h"
#include "scenarios/study/study.h"

namespace morula::app {

/// Read a study with the program's own lists of observables and library studies; its messages go to standard error. On failure the error
/// has no text, for all was told.
Result<scenarios::Study> read_study_and_tell(const std::string& path, const std::vector<std::string>& overrides, bool strict,
                                             const Context& context);

}  // namespace morula::app
