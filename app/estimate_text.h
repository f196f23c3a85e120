#pragma once
#include <string>

#include "core/result.h"
#include "study/study.h"

namespace morula::app {

/// Size, memory and time of a run on this many ranks, a few lines for people. Places the cells of time 0.
Result<std::string> estimate_text(const scenarios::Study& study, int ranks);

}  // namespace morula::app
