#pragma once
#include <filesystem>
#include <vector>

#include "core/result.h"
#include "report/run_plots.h"
#include "results/run_record.h"
#include "study/study.h"

namespace morula::scenarios {

/// What holds for every run (physics/scenarios.md §0.3), judged on series.csv: volumes against the law (INV.3), overlap (INV.4), nuclei
/// within their cells (INV.5), balance of the fields, and for passive runs that the energy falls (INV.7). A column that is not there, or
/// without rows, fails; what does not apply to the study, or is not seen in a series, is named as not checked.
Result<Judgement> common_criteria(const Study& study, const std::filesystem::path& run);

/// common_criteria, then those of the study: judged on what is in the run's folder (series.csv, results.h5, events.jsonl). kFile where
/// something is missing.
Result<Judgement> judge(const Study& study, const std::filesystem::path& run);

/// The plots that the study declares.
Result<std::vector<NamedPlot>> declared_plots(const Study& study, const std::filesystem::path& run);

/// The plots that the study declares, then those of every run (standard_plots); where both have a name, the study's is the plot of that name.
Result<std::vector<NamedPlot>> plots_of(const Study& study, const std::filesystem::path& run, const SeriesTable& series);

/// Whether nothing drives the tissue: no growth, migration, death, exchange of bodies, renewal of meshes, inflation or moving obstacle. Its energy can only
/// fall.
bool is_passive(const Study& study);

}  // namespace morula::scenarios
