#pragma once
#include <filesystem>
#include <vector>

#include "scenarios/library/criteria.h"

namespace morula::scenarios {

/// S17: an aggregate of 16 cells from a mesh file. Which of its criteria hold for a run follows from the study: inference from the file where it
/// tells pressures, a hold where adhesion balances the tensions of the file (W = T), the opening of contacts where it is weaker, and their
/// closing where a run with that adhesion starts with open contacts.
Result<std::vector<Verdict>> judge_embryo(const Study& study, const std::filesystem::path& run);
Status embryo_needs(const Study& study);

/// Tension from curvature by cell, contact angles by pair, and contact fraction and pressure over time.
Result<std::vector<NamedPlot>> plot_embryo(const Study& study, const std::filesystem::path& run);

}  // namespace morula::scenarios
