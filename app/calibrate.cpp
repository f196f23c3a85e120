#include <omp.h>

#include <cmath>
#include <filesystem>

#include "app/read_study.h"
#include "app/signals.h"
#include "app/verbs.h"
#include "app/words.h"
#include "core/numbers/number_text.h"
#include "results/file_io.h"
#include "scenarios/experiments/calibration.h"

namespace morula::app {
namespace {

namespace fs = std::filesystem;

std::string number(double value) { return number_text("%.3g", value); }

std::string interval_text(const calibrate::Interval& interval, const char* unit) {
  if (interval.low <= 0.0 || !std::isfinite(interval.high)) return "not bounded by the data";
  return number(interval.low) + " to " + number(interval.high) + " " + unit;
}

std::string found_text(const scenarios::Calibration& found) {
  const calibrate::Parameters& p = found.sure.fit.parameters;
  return "E  " + number(p.young) + " kPa   95 %: " + interval_text(found.sure.young.interval, "kPa") + "\n" + "W  " + number(p.adhesion) +
         " nN/um   95 %: " + interval_text(found.sure.adhesion.interval, "nN/um") + "\n";
}

}  // namespace

Status calibrate(const CalibrateOptions& options, const Context& context) {
  outlive_closed_pipes();
  auto study = read_study_and_tell(options.study, options.overrides, false, context, {.fitted_laws = false, .judge_places = false});
  MORULA_TRY(agree_on(study, options.study, context));
  omp_set_num_threads(options.threads);
  scenarios::ExperimentRequest request;
  request.folder = options.out.empty() ? fs::path("calibrations") / options.type : fs::path(options.out);
  std::error_code ignored;
  if (fs::exists(request.folder, ignored) && !fs::is_directory(request.folder, ignored))
    return Error{ErrorKind::kFile, "'" + request.folder.string() + "' is no folder", "give --out a folder, or the name of a new one"};
  request.threads = options.threads;
  request.packings = !options.pairs_only;
  if (!options.budget.empty()) {
    MORULA_TRY_ASSIGN(request.budget, read_time("--budget", options.budget));
  }
  request.stop = &watch_signals();
  request.on_note = [&](const std::string& text) { context.console.note(text); };
  MORULA_TRY_ASSIGN(const scenarios::Calibration found, scenarios::calibrate_jkr(*study, options.type, request, context.comm));
  if (!context.comm.is_root()) return {};
  const fs::path file = request.folder / (options.type + ".jkr.yaml");
  MORULA_TRY(scenarios::write_file_atomically(file, scenarios::calibration_text(found)));
  MORULA_TRY(scenarios::write_calibration_report(found, context.command, request.folder / "report.html"));
  context.console.result(found_text(found) + file.string() + "\n" + (request.folder / "report.html").string());
  return {};
}

}  // namespace morula::app
