#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/verbs.h"
#include "study/study.h"

namespace morula::app {

/// Read a study with the program's own lists of observables and library studies; its messages go to standard error. On failure the error
/// has no text, for all was told. Of `options` the caller says what is not to be looked at: places that the cells have left long ago, files that are about
/// to be made.
Result<scenarios::Study> read_study_and_tell(const std::string& path, const std::vector<std::string>& overrides, bool strict,
                                             const Context& context, scenarios::ReadOptions options = {});

/// Collective. Success where every rank has read the study; else the error, with a text of its own if only other ranks have failed.
Status agree_on(const Result<scenarios::Study>& study, const std::string& path, const Context& context);

}  // namespace morula::app
