#pragma once
#include <filesystem>
#include <vector>

#include "scenarios/library/criteria.h"

namespace morula::scenarios {

/// Experiments on one or two cells: criteria (physics/scenarios.md S1 to S6; dcm.md T9.6; a cell between plates) and plots against theory.
Result<std::vector<Verdict>> judge_optical_stretcher(const Study& study, const std::filesystem::path& run);
Result<std::vector<Verdict>> judge_optical_tweezers(const Study& study, const std::filesystem::path& run);

Result<std::vector<Verdict>> judge_pull_off(const Study& study, const std::filesystem::path& run);
Result<std::vector<Verdict>> judge_micropipette(const Study& study, const std::filesystem::path& run);
Result<std::vector<Verdict>> judge_cell_shear(const Study& study, const std::filesystem::path& run);

Result<std::vector<NamedPlot>> plot_optical_stretcher(const Study& study, const std::filesystem::path& run);
Result<std::vector<NamedPlot>> plot_optical_tweezers(const Study& study, const std::filesystem::path& run);
Result<std::vector<NamedPlot>> plot_pull_off(const Study& study, const std::filesystem::path& run);
Result<std::vector<NamedPlot>> plot_micropipette(const Study& study, const std::filesystem::path& run);
Result<std::vector<NamedPlot>> plot_cell_shear(const Study& study, const std::filesystem::path& run);

}  // namespace morula::scenarios
