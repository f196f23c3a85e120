#pragma once
#include "scenarios/library/criteria.h"

namespace morula::scenarios {

/// S18.4 of the blastocyst with a cavity whose pressure is switched on in the middle of the run: the cavity is larger with pressure than
/// without, and does not leak. For the first cavity of a study, none where it has none; the row before the first pressure is what it is compared
/// with.
Result<std::vector<Verdict>> judge_cavity(const Study& study, const std::filesystem::path& run);

}  // namespace morula::scenarios
