#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/parallel/comm.h"
#include "core/result.h"
#include "scenarios/calibrate/confidence.h"
#include "scenarios/experiments/data_of_runs.h"
#include "scenarios/experiments/run_experiments.h"
#include "study/study.h"

namespace morula::scenarios {

/// A contact law of spheres, found from deformable cells.
struct Calibration {
  CellMaterial material;
  std::vector<Experiment> experiments;
  std::vector<ExperimentOutcome> outcomes;
  ExperimentData data;
  calibrate::SureFit sure;
};

/// Runs the experiments for a cell type of a study in the folder of the request, and fits JKR and a packing curve to what they find. Everything that was
/// run before in that folder is taken over. The result is the same on any number of ranks and threads, and after any break. Collective; the fit is
/// made on the root, and the others get what is known before it. Errors: those of material_of(), run_experiments(), data_of_runs() and the fit.
Result<Calibration> calibrate_jkr(const Study& study, const std::string& type, const ExperimentRequest& request, const Comm& comm);

/// report.html of a calibration: points and fits, residuals, profiles, numbers with their intervals, remarks. `command`: as typed.
Status write_calibration_report(const Calibration& found, const std::string& command, const std::filesystem::path& path);

}  // namespace morula::scenarios
