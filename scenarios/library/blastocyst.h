#pragma once
#include "scenarios/library/criteria.h"

namespace morula::scenarios {

/// S18.1, S18.2, S18.3 and, where a region lasts for a while only, S18.6 of the measured blastocyst. The overlap of S18.2 is INV.4, which
/// every run has. The cells of the type `TE` are the outer layer; the first entry of `initial` must be the CSV file.
Result<std::vector<Verdict>> judge_blastocyst(const Study& study, const std::filesystem::path& run);
Status blastocyst_needs(const Study& study);

}  // namespace morula::scenarios
