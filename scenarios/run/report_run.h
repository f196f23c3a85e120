#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "report/pictures/coloring.h"
#include "results/run_folder.h"
#include "results/run_record.h"
#include "results/snapshot.h"
#include "study/study.h"

namespace morula::scenarios {

/// What stands beside the results when a run is done.
struct RunOutputs {
  Judgement judgement;
  std::filesystem::path report;  ///< empty: the study wants none
};

/// verdict.json, methods.md, vtk/ where asked for, and plots/ with report.html where asked for. On one process.
Result<RunOutputs> finish_outputs(const Study& study, const RunRecord& record, const RunFolder& folder);

/// plots/*.svg (with their numbers as CSV), plots/*.png and report.html from what is in a run's folder, also of a run that goes on or
/// failed. Returns the path of the report. On one process.
Result<std::filesystem::path> write_run_report(const Study& study, const RunRecord& record, const std::filesystem::path& run,
                                               const Judgement& judgement);

/// The same for a run on disk, its study and record read from there: `morula plot RUN`.
Result<std::filesystem::path> plot_run(const std::filesystem::path& run, std::shared_ptr<const Laws> laws = builtin_laws());

/// The snapshots nearest to 0, 25, 50, 75 and 100 % of the time, each once. One that is damaged is left out; `damaged` gets its time [s] and why.
Result<std::vector<Snapshot>> snapshots_over_time(const std::filesystem::path& results,
                                                  std::vector<std::pair<double, std::string>>& damaged);

/// The colours that the study gives to its types.
TypeColors type_colors(const Study& study);

/// The study of a run as it was resolved, with the run's copies of its input files; `laws` are those of the program that ran it.
Result<Study> read_run_study(const std::filesystem::path& run, std::shared_ptr<const Laws> laws = builtin_laws());

}  // namespace morula::scenarios
