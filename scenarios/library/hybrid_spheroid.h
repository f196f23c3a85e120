#pragma once
#include "scenarios/library/criteria.h"

namespace morula::scenarios {

/// What the demo is to show: a core of 40 to 60 shells, about 400 cells (S7 of physics/scenarios.md asks the rest), cells in contact, no cell
/// that changes its body more than once per 30 min (S7.8), and no more swaps than cells that cross the border can explain.
Result<std::vector<Verdict>> judge_hybrid_spheroid(const Study& study, const std::filesystem::path& run);
Status hybrid_spheroid_needs(const Study& study);

}  // namespace morula::scenarios
