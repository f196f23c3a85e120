#pragma once
#include "scenarios/library/criteria.h"

namespace morula::scenarios {

/// S18.4 of the blastocyst with a cavity whose pressure is switched on in the middle of the run: the cavity is larger with pressure than
/// without, and does not leak. For the first cavity of a study; the row before the first pressure is what it is compared with.
Result<std::vector<Verdict>> judge_cavity(const Study& study, const std::filesystem::path& run);
Status cavity_needs(const Study& study);

}  // namespace morula::scenarios
