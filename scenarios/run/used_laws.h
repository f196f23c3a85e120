#pragma once
#include <vector>

#include "report/methods.h"
#include "study/study.h"

namespace morula::scenarios {

/// The laws that a study switches on, with the values it gives them: what methods.md and the report show.
std::vector<UsedLaw> used_laws(const Study& study);

/// Those of coupling/active_laws.cpp, appended; `shells`: cells may be shells.
void add_active_laws(const Model& model, bool shells, std::vector<UsedLaw>& out);

}  // namespace morula::scenarios
