#include "scenarios/experiments/calibration.h"

#include <utility>

#include "results/file_io.h"

namespace morula::scenarios {
namespace {

/// What only the root does, once all runs are there.
Status fit_on_root(const Study& study, Calibration& out) {
  MORULA_TRY_ASSIGN(out.data, data_of_runs(out.experiments, out.outcomes));
  const auto type = std::ranges::find(study.model.types, out.material.type, &CellType::name);
  calibrate::FitOptions options;
  options.poisson = type->sphere.poisson;
  options.seed = study.model.seed;
  MORULA_TRY_ASSIGN(out.sure, calibrate::fit_with_confidence(out.data.points, options));
  return {};
}

}  // namespace

Result<Calibration> calibrate_jkr(const Study& study, const std::string& type, const ExperimentRequest& request, const Comm& comm) {
  Calibration out;
  MORULA_TRY_ASSIGN(out.material, material_of(study, type));
  out.experiments = experiments_for(out.material);
  MORULA_TRY_ASSIGN(out.outcomes, run_experiments(out.experiments, request, comm));
  MORULA_TRY(agree(comm.is_root() ? fit_on_root(study, out) : Status{}, comm));
  return out;
}

}  // namespace morula::scenarios
