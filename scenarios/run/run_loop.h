#pragma once
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "coupling/observables/measures.h"
#include "coupling/observables/observable.h"
#include "coupling/simulation.h"
#include "results/checkpoint.h"
#include "results/run_folder.h"
#include "results/snapshot_file.h"
#include "scenarios/run/driver.h"
#include "scenarios/run/timings.h"

namespace morula::scenarios {

/// What results.h5 says of the run of a study.
ResultsHead results_head(const Study& study);

/// The first output time after `time`: the next multiple of the interval, or the end if that comes first [s].
double next_output(double time, double interval, double end);
/// `until` rounded up to a multiple of the output interval, or to the end where it lies before the end and the multiple does not [s].
double end_of_run(const TimeSpec& time, const std::optional<double>& until);

/// A run while it goes on: the simulation, its folder, and what is due next. All members that call MPI are called by all ranks.
class RunLoop {
 public:
  RunLoop(const Study& study, const RunRequest& request, const Comm& comm, RunFolder folder, std::vector<Observable> columns,
          RunRecord record, std::unique_ptr<Simulation> simulation);

  /// Time 0: the first exchange of bodies, the first row, snapshot and checkpoint.
  Status begin();
  /// After a restart: take away what is later than the checkpoint.
  Status go_back(const CheckpointInfo& checkpoint);
  /// To the end, a wish to stop, or an error.
  Result<RunSummary> go();
  /// Mark the run as failed; the error with the run's name in it.
  Error fail(Error error, bool state_is_sound);

  void note(Note::Kind kind, const std::string& text);
  [[nodiscard]] const RunFolder& folder() const { return folder_; }
  [[nodiscard]] double end() const { return end_; }

 private:
  using SteadyClock = std::chrono::steady_clock;

  /// status.json of a run that has begun, and the head of series.csv.
  Status begin_texts();
  Status step(double land_on);
  /// The study asks to end at rest, and nothing moves or will move any more. Collective.
  [[nodiscard]] bool at_rest();
  Status output();
  Status write_moment(const Measures& measures);
  /// series.csv and events.jsonl into results.h5. Collective.
  Status write_tables();
  /// After going back: warns where rows of the series and snapshots (known at the root) are not as many; a series that cannot be read is an error. Collective.
  Status tell_what_is_lost(std::size_t snapshots);
  Status check_limits(const Measures& measures);
  Status check_packing(const Measures& measures);
  [[nodiscard]] Status check_capped_start() const;
  void tell_contacts_beyond(const Measures& measures);
  void tell_shells_beyond_budget(const Measures& measures);
  /// A warning of the run itself: for people, and into events.jsonl.
  void warn(const std::string& text);
  /// Events of a step, to be written by the root at the next output.
  void keep_events(std::span<const Event> events);
  Status write_events();
  /// Things of which a run warns once; the bits of CheckpointInfo::warned.
  enum Warned : std::uint32_t {
    kPacking = 1,
    kVolume = 2,
    kOverlap = 4,
    kBalance = 8,
    kBeyondRange = 16,
    kMoreShells = 32,
    kToAndFro = 64,
    kOutsideFields = 128,
    kCreeping = 256,
    kDrawnOut = 512,
    kCavityOpen = 1024,
    kCavityLeaks = 2048,
    kCavityHidden = 4096
  };
  void warn_near_limit(Warned what, const std::string& text);
  /// Writes into results.h5; where its content is in the way, once more into a new one. Collective.
  Status write_results(const std::function<Status()>& write);
  void tell_idle_loads();
  void tell_cavities(const Measures& measures);
  /// Warns of a run that hardly moves on: nobody looks at the step of a run over night.
  void tell_creeping(const StepOutcome& outcome);
  void tell_events();
  /// Warns of cells that change their body again and again: a rule asks for a shell what only spheres answer so.
  void tell_to_and_fro(const Event& event, const std::string& reason);
  Status checkpoint();
  Status finish(RunState state, ErrorKind kind, RunSummary& summary);
  [[nodiscard]] int wish_to_stop() const;
  [[nodiscard]] double wall() const { return std::chrono::duration<double>(SteadyClock::now() - start_).count(); }
  [[nodiscard]] RunStatus status(RunState state) const;
  [[nodiscard]] FinalState final_state() const;
  void count_cells();
  /// What the cost of the time ahead is told by: how cells multiply, and for how many shells there is room. Cells have been counted.
  void expect_growth(const std::vector<std::int64_t>& of_type);
  void tell_progress(double simulated, double seconds);

  const Study& study_;
  const RunRequest& request_;
  Comm comm_;
  RunFolder folder_;
  std::vector<Observable> columns_;
  RunRecord record_;
  std::unique_ptr<Simulation> simulation_;
  double end_ = 0.0;
  double checkpoint_due_ = 0.0;
  double wall_before_ = 0.0;  ///< of earlier parts of the run [s]
  SteadyClock::time_point start_ = SteadyClock::now(), last_status_ = SteadyClock::now();
  Interval interval_;
  WorkDone work_;
  CostModel cost_;
  Progress progress_;
  Load load_;
  double output_seconds_ = 0.0;       ///< that an output takes, as the last ones did
  double last_output_ = 0.0;          ///< moment of it, or that at which this part of the run began [s]
  double growth_rate_ = 0.0;          ///< of the spheres, if nothing inhibits it [1/s]
  std::vector<ToldEvent> events_;     ///< of the tissue, not yet written
  std::map<CellId, int> promotions_;  ///< of each cell by a trigger, since the run began or was resumed
  bool rested_ = false;               ///< at_rest() ended the run
  std::vector<std::string> awaited_;  ///< what was still to come when nothing moved, as last told
  std::vector<ToldEvent> warnings_;   ///< of the run, not yet written
  bool state_is_whole_ = true;
  Status text_status_;        ///< the first failure of a text written between outputs
  std::uint32_t warned_ = 0;  ///< bits of Warned
  int short_steps_ = 0;       ///< in a row
};

}  // namespace morula::scenarios
