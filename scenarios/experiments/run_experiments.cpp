#include "scenarios/experiments/run_experiments.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>
#include <system_error>

#include "core/parallel/threads.h"
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

/// Experiments of this rank, the longest first: each goes to the rank that has least to do.
std::vector<std::size_t> share_of(const Comm& comm, std::span<const Experiment> experiments) {
  std::vector<std::size_t> order(experiments.size()), out;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return experiments[a].work > experiments[b].work; });
  std::vector<double> load(static_cast<std::size_t>(comm.size()), 0.0);
  for (const std::size_t e : order) {
    const auto least = std::ranges::min_element(load);
    *least += experiments[e].work;
    if (least - load.begin() == comm.rank()) out.push_back(e);
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

Result<RunSummary> run_it(const Paths& paths, const Experiment& experiment, const ResumeRequest& asked) {
  const auto there = read_file(paths.study);
  const bool same = there.ok() && *there == experiment.text;
  std::error_code ignored;
  ResumeRequest how = asked;
  if (same && fs::exists(RunFiles(paths.run).record(), ignored)) {
    if (auto done = resume(paths.run, how, Comm()); done.ok()) return done;
  }
  MORULA_TRY(begin_anew(paths, experiment));
  const auto study = read_study(paths.study);
  if (!study.ok()) return Error{ErrorKind::kInternal, "its study is refused: " + study.error().text(), ""};
  how.out = paths.run;
  return run(*study, how, Comm());
}

/// Runs one that is not done yet, while this run has its turn. An error of an experiment is told and written, one that ends all is given back.
Status run_and_tell(const Experiment& experiment, const ExperimentRequest& request, int threads, std::unique_lock<std::mutex>& turn) {
  const Paths paths(request.folder, experiment.name);
  const auto tell = [&](const std::string& text) {
    if (request.on_note) request.on_note(experiment.name + ": " + text);
  };
  const auto there = read_file(paths.study);
  if (there.ok() && *there == experiment.text && is_done(paths)) return {};
  std::error_code ignored;
  fs::remove(paths.problem, ignored);
  tell(experiment.purpose);
  ResumeRequest how;
  how.threads = threads;
  how.stop = request.stop;
  how.turn = &turn;
  const auto done = run_it(paths, experiment, how);
  const int wish = request.stop != nullptr ? request.stop->load() : kGoOn;
  if (wish != kGoOn)
    return Error{wish == kInterrupt ? ErrorKind::kInterrupted : ErrorKind::kStoppedEarly, "the calibration was stopped",
                 "the same command goes on with it"};
  if (done.ok()) return {};
  tell(done.error().message);
  (void)write_file_atomically(paths.problem, done.error().message);
  return done.error().kind == ErrorKind::kResources ? Status(done.error()) : Status{};
}

}  // namespace

Result<std::vector<ExperimentOutcome>> run_experiments(std::span<const Experiment> experiments, const ExperimentRequest& request,
                                                       const Comm& comm) {
  const std::vector<std::size_t> share = share_of(comm, experiments);
  const int threads_of_one = share.size() == 1 ? request.threads : 1;  // one alone has them all
  std::mutex one_at_a_time;
  Status stopped;
  one_by_one(request.threads, share.size(), [&](std::size_t k) {
    std::unique_lock turn(one_at_a_time);
    if (!stopped.ok()) return;
    Status ended = run_and_tell(experiments[share[k]], request, threads_of_one, turn);
    if (stopped.ok()) stopped = std::move(ended);
  });
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
