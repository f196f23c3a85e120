#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "report/run_plots.h"
#include "results/run_record.h"
#include "study/study.h"

namespace morula::scenarios {

/// Criteria of one library study: judged on what is in the run's folder (series.csv, results.h5, events.jsonl). kFile where something is
/// missing.
using Judge = Result<std::vector<Verdict>> (*)(const Study& study, const std::filesystem::path& run);

/// Plots of one library study beside those of every run: against theory or data.
using Plotter = Result<std::vector<NamedPlot>> (*)(const Study& study, const std::filesystem::path& run);

/// What a study must have for the criteria of its scenario, as the message of an error: "cells from one CSV file"; ok where it has it.
using Needs = Status (*)(const Study& study);

struct ScenarioCriteria {
  std::string scenario;  ///< `scenario:` of the study
  Judge judge = nullptr;
  Needs needs = nullptr;         ///< null: nothing
  std::vector<std::string> ids;  ///< all criteria that it has
  Plotter plots = nullptr;       ///< may be null
};

/// All library studies that have criteria of their own: one line each.
const std::vector<ScenarioCriteria>& scenario_criteria();

/// Whether the study has what the criteria of its scenario judge, and `criteria` names such as this scenario has: what
/// ReadOptions::fits_scenario asks. kInput.
Status fits_scenario(const Study& study);

/// What holds for every run (physics/scenarios.md §0.3), judged on series.csv: volumes against the law (INV.3), overlap (INV.4), nuclei
/// within their cells (INV.5), balance of the fields, and for passive runs that the energy falls (INV.7). A column that is not there, or
/// without rows, fails; what does not apply to the study, or is not seen in a series, is named as not checked.
Result<Judgement> common_criteria(const Study& study, const std::filesystem::path& run);

/// common_criteria, those of the study with measures of their own, then those of the study's scenario. Each criterion that `criteria` of
/// the study names must have been judged, and one at least where it names none; what found nothing to judge has failed.
Result<Judgement> judge(const Study& study, const std::filesystem::path& run);

/// The plots that the study declares, then those of its scenario.
Result<std::vector<NamedPlot>> scenario_plots(const Study& study, const std::filesystem::path& run);

/// Whether nothing drives the tissue: no growth, migration, death, exchange of bodies, renewal of meshes, inflation or moving obstacle. Its energy can only
/// fall.
bool is_passive(const Study& study);

}  // namespace morula::scenarios
