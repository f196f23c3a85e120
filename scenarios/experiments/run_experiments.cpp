#include "scenarios/experiments/run_experiments.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <system_error>

#include "results/file_io.h"
#include "results/run_files.h"
#include "results/run_record.h"
#include "study/study.h"

namespace morula::scenarios {
namespace {

namespace fs = std::filesystem;

struct Paths {
  fs::path study, run, problem;
  Paths(const fs::path& folder, const std::string& name)
      : study(folder / name / "study.yaml"), run(folder / name / "run"), problem(folder / name / "problem.txt") {}
};

bool is_done(const Paths& paths) {
  const auto record = read_run_record(RunFiles(paths.run).record());
  return record.ok() && record->state == RunState::kDone;
}

/// Rank by experiment: the longest first, each to the rank that has least to do. The same on every rank.
std::vector<int> shared_out(std::span<const Experiment> experiments, int ranks) {
  std::vector<std::size_t> order(experiments.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return experiments[a].work > experiments[b].work; });
  std::vector<double> load(static_cast<std::size_t>(ranks), 0.0);
  std::vector<int> out(experiments.size());
  for (const std::size_t e : order) {
    const auto least = std::ranges::min_element(load);
    *least += experiments[e].work;
    out[e] = static_cast<int>(least - load.begin());
  }
  return out;
}

/// What is there of another study, or too broken to go on from, goes.
Status begin_anew(const Paths& paths, const Experiment& experiment) {
  std::error_code error;
  fs::remove_all(paths.run, error);
  fs::create_directories(paths.study.parent_path(), error);
  if (error) return Error{ErrorKind::kFile, "cannot make '" + paths.study.parent_path().string() + "': " + error.message(), ""};
  return write_file_atomically(paths.study, experiment.text);
}

Result<RunSummary> run_it(const Paths& paths, const Experiment& experiment, const ExperimentRequest& request) {
  const auto there = read_file(paths.study);
  const bool same = there.ok() && *there == experiment.text;
  std::error_code ignored;
  ResumeRequest how;
  how.threads = request.threads;
  how.stop = request.stop;
  if (same && fs::exists(RunFiles(paths.run).record(), ignored)) {
    if (auto done = resume(paths.run, how, Comm()); done.ok()) return done;
  }
  MORULA_TRY(begin_anew(paths, experiment));
  const auto study = read_study(paths.study);
  if (!study.ok()) return Error{ErrorKind::kInternal, "its study is refused: " + study.error().text(), ""};
  how.out = paths.run;
  return run(*study, how, Comm());
}

}  // namespace

Result<std::vector<ExperimentOutcome>> run_experiments(std::span<const Experiment> experiments, const ExperimentRequest& request,
                                                       const Comm& comm) {
  const std::vector<int> rank_of = shared_out(experiments, comm.size());
  const auto tell = [&](const std::string& text) {
    if (request.on_note) request.on_note(text);
  };
  Status stopped;
  for (std::size_t e = 0; e < experiments.size() && stopped.ok(); ++e) {
    const Experiment& experiment = experiments[e];
    const Paths paths(request.folder, experiment.name);
    if (rank_of[e] != comm.rank()) continue;
    const auto there = read_file(paths.study);
    if (there.ok() && *there == experiment.text && is_done(paths)) continue;
    std::error_code ignored;
    fs::remove(paths.problem, ignored);
    tell(experiment.name + ": " + experiment.purpose);
    const auto done = run_it(paths, experiment, request);
    const int wish = request.stop != nullptr ? request.stop->load() : kGoOn;
    if (wish != kGoOn) {
      stopped = Error{wish == kInterrupt ? ErrorKind::kInterrupted : ErrorKind::kStoppedEarly, "the calibration was stopped",
                      "the same command goes on with it"};
      break;
    }
    if (!done.ok() && done.error().kind == ErrorKind::kResources) stopped = done.error();
    if (!done.ok()) {
      tell(experiment.name + ": " + done.error().message);
      (void)write_file_atomically(paths.problem, done.error().message);
    }
  }
  MORULA_TRY(agree(std::move(stopped), comm));
  std::vector<ExperimentOutcome> out;
  for (const Experiment& experiment : experiments) {
    const Paths paths(request.folder, experiment.name);
    ExperimentOutcome& one = out.emplace_back();
    one.run = paths.run;
    one.done = is_done(paths);
    if (one.done) continue;
    const auto problem = read_file(paths.problem);
    one.problem = problem.ok() ? *problem : "it did not come to its end";
  }
  return out;
}

}  // namespace morula::scenarios
