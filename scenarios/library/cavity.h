#pragma once
#include "scenarios/library/criteria.h"
#include "scenarios/results/snapshot.h"

namespace morula::scenarios {

/// S18.4 of the blastocyst with a cavity whose pressure is switched on in the middle of the run: the cavity is larger with pressure than
/// without, and does not leak. For the first cavity of a study, none where it has none; the row before the first pressure is what it is compared
/// with.
Result<std::vector<Verdict>> judge_cavity(const Study& study, const std::filesystem::path& run);

/// Mean height of the cells of a type about a cavity [µm]: the extent of each along the way from the cavity's centre to its own. For S18.5.
double mean_height(const Snapshot& moment, std::uint16_t type, const Vec3d& cavity);

}  // namespace morula::scenarios
