#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/parallel/comm.h"
#include "core/result.h"
#include "results/run_record.h"
#include "scenarios/run/progress.h"
#include "study/study.h"

namespace morula::scenarios {

/// What a signal handler or another thread may ask of a run; honoured between two steps, with a checkpoint of that very state.
enum StopWish : int {
  kGoOn = 0,
  kStopEarly = 1,  ///< SIGTERM, SIGUSR1: kStoppedEarly
  kInterrupt = 2,  ///< Ctrl-C: kInterrupted
};

/// A line for people while a run goes on.
struct Note {
  enum class Kind { kNote, kWarning } kind = Kind::kNote;
  double time = 0.0;  ///< [s]
  std::string text;
};

/// How a study is to be run.
struct RunRequest {
  std::filesystem::path runs = "runs";  ///< folder of numbered runs
  std::filesystem::path out;            ///< exactly this folder instead
  std::string command;                  ///< for run.json
  int threads = 1;
  std::optional<double> until;                                ///< rounded up to the next output time; may lie beyond the study's end [s]
  double max_wall = std::numeric_limits<double>::infinity();  ///< [s]
  const std::atomic<int>* stop = nullptr;                     ///< a StopWish
  /// Of a run beside others of the same process: held by whoever calls, and let go while a step is made. HDF5 knows one thread only.
  std::unique_lock<std::mutex>* turn = nullptr;
  bool timings = false;                                        ///< write the budget per stage into run.json
  std::vector<std::string> warnings;                           ///< what the caller has to say of this machine; told first
  std::function<void(const std::filesystem::path&)> on_start;  ///< on the root, when the run's folder is there
  std::function<void(const Progress&)> on_progress;            ///< on the root, after every step
  std::function<void(const Note&)> on_note;                    ///< on the root
};

/// How a resumed run differs.
struct ResumeRequest : RunRequest {
  std::filesystem::path from;                         ///< this checkpoint instead of the newest good one
  std::shared_ptr<const Laws> laws = builtin_laws();  ///< that the run's study may name
};

/// How a run ended that did not fail.
struct RunSummary {
  std::filesystem::path path;
  RunState state = RunState::kDone;  ///< kDone or kStopped
  std::optional<ErrorKind> stopped;  ///< kStoppedEarly or kInterrupted
  FinalState final_state;
  double wall_time = 0.0;         ///< of this call [s]
  std::vector<Verdict> verdicts;  ///< of a run that is done, on the root
  bool passed = true;             ///< none of them failed; the same on every rank
  std::string timings;            ///< the table, if asked for
  std::filesystem::path report;   ///< empty: none written
};

/// Run a study into a new folder. Collective.
///
/// Steps land exactly on every multiple of the output interval and on the end: the sequence of steps depends on the study alone, so that a
/// run that is stopped anywhere and resumed ends in the same bits. Errors: kFile (folder exists or cannot be made), kPhysics (a limit is
/// crossed, or no step size works: the run is marked FAILED and has a checkpoint), kResources (disk full: FAILED, earlier checkpoints are
/// whole). The message of a run that has begun names its folder.
Result<RunSummary> run(const Study& study, const RunRequest& request, const Comm& comm);

/// Go on with a run from its newest good checkpoint, on any number of ranks and threads. What lies beyond the checkpoint in series, events
/// and snapshots is taken away first. `until` beyond the study's end extends the run. Means over an output interval that was begun before
/// the restart (step size, iterations) count from the restart; the state itself is the same to the bit. Collective.
Result<RunSummary> resume(const std::filesystem::path& run, const ResumeRequest& request, const Comm& comm);

/// Start a new run of a changed study from a checkpoint of another run, which is recorded as its parent and left as it is. Collective.
/// Errors as of `run`, and kInput when the state does not fit the study (other cell types, fields or obstacles).
Result<RunSummary> branch(const std::filesystem::path& parent, const Study& study, const ResumeRequest& request, const Comm& comm);

}  // namespace morula::scenarios
