#pragma once
#include <vector>

#include "scenarios/report/methods.h"
#include "scenarios/study/study.h"

namespace morula::scenarios {

/// The laws that a study switches on, with the values it gives them: what methods.md and the report show.
std::vector<UsedLaw> used_laws(const Study& study);

}  // namespace morula::scenarios
