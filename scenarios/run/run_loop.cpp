#include "scenarios/run/run_loop.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/numbers/joined.h"
#include "core/numbers/number_text.h"
#include "core/shell_word.h"
#include "results/checkpoint_folder.h"
#include "results/damaged_file.h"
#include "results/file_io.h"
#include "results/observables/local_snapshot.h"
#include "results/series_reader.h"
#include "results/snapshot_file.h"
#include "results/state_hash.h"
#include "scenarios/run/exit_code.h"
#include "scenarios/run/report_run.h"

namespace morula::scenarios {
namespace {

constexpr auto kStatusEvery = std::chrono::seconds(2);

constexpr double kSameTime = 1e-12;  // moments that differ by less than this part of them are one: 3 × 0.7 s is not 2.1 s

/// Lets others of the process have their turn for as long as it lives.
class OthersTurn {
 public:
  explicit OthersTurn(std::unique_lock<std::mutex>* turn) : turn_(turn) {
    if (turn_ != nullptr) turn_->unlock();
  }
  ~OthersTurn() {
    if (turn_ != nullptr) turn_->lock();
  }
  OthersTurn(const OthersTurn&) = delete;
  OthersTurn& operator=(const OthersTurn&) = delete;

 private:
  std::unique_lock<std::mutex>* turn_;
};

/// The first multiple of the interval that is later than `time`.
double next_multiple(double time, double interval) {
  double k = std::floor(time / interval);
  while (k * interval <= time * (1.0 + kSameTime)) ++k;
  return k * interval;
}

}  // namespace

ResultsHead results_head(const Study& study) {
  return {study.name, study.title, study.model.seed, study.source_text, study.resolved_text, obstacles_at_start(study.model)};
}

double next_output(double time, double interval, double end) {
  const double next = next_multiple(time, interval);
  return next >= end * (1.0 - kSameTime) ? end : next;
}

double end_of_run(const TimeSpec& time, const std::optional<double>& until) {
  if (!until) return time.end;
  double k = std::floor(*until / time.output);
  while (k * time.output < *until * (1.0 - 1e-12)) ++k;
  const double rounded = k * time.output;
  return *until <= time.end ? std::min(rounded, time.end) : rounded;
}

RunLoop::RunLoop(const Study& study, const RunRequest& request, const Comm& comm, RunFolder folder, std::vector<Observable> columns,
                 RunRecord record, std::unique_ptr<Simulation> simulation)
    : study_(study),
      request_(request),
      comm_(comm),
      folder_(std::move(folder)),
      columns_(std::move(columns)),
      record_(std::move(record)),
      simulation_(std::move(simulation)),
      end_(end_of_run(study.time, request.until)),
      wall_before_(record_.wall_time),
      cost_(longest_step(study)) {
  last_output_ = simulation_->tissue().clock.time;
  checkpoint_due_ = next_multiple(last_output_, study.time.checkpoint);
  progress_.end = end_;
  count_cells();
  std::vector<std::int64_t> of_type(study.model.types.size(), 0);
  for (const CellRow& row : simulation_->tissue().cells.rows) ++of_type[row.type];
  for (std::int64_t& count : of_type) count = comm_.sum(count);
  expect_growth(of_type);
}

void RunLoop::expect_growth(const std::vector<std::int64_t>& of_type) {
  growth_rate_ = free_growth_rate(study_.model, of_type, end_ - simulation_->tissue().clock.time);
  load_.most_shells = most_shells(study_.model, static_cast<double>(progress_.cells));
}

Status RunLoop::begin_texts() {
  MORULA_TRY(agree(folder_.write_status(status(RunState::kRunning)), comm_));  // whose process it is, whatever comes
  std::vector<SeriesHeader> header;
  for (const Observable& column : columns_) header.push_back({column.name, column.unit});
  return agree(folder_.begin_series(header), comm_);
}

Status RunLoop::begin() {
  MORULA_TRY(begin_texts());
  if (comm_.is_root()) text_status_ = append_to_text(folder_.events(), "");
  auto placed = simulation_->first_swaps();
  if (!placed.ok()) {  // some cells have their new body but not yet their shape: no state to go on from
    state_is_whole_ = false;
    return std::move(placed).error();
  }
  keep_events(*placed);
  count_cells();
  tell_idle_loads();
  MORULA_TRY(begin_results(folder_.results(), results_head(study_), comm_));
  MORULA_TRY(output());
  return checkpoint();
}

Status RunLoop::go_back(const CheckpointInfo& checkpoint) {
  warned_ = checkpoint.warned;
  interval_ = checkpoint.interval;
  MORULA_TRY(begin_texts());
  const double time = simulation_->tissue().clock.time;
  const Result<bool> events_lost = folder_.cut_back(time, checkpoint.texts);
  MORULA_TRY(agree(events_lost.ok() ? Status{} : Status(events_lost.error()), comm_));
  std::size_t snapshots = 0;
  const auto go_on_with_results = [&]() -> Status {
    MORULA_TRY(truncate_snapshots(folder_.results(), time, comm_));
    MORULA_TRY(begin_results(folder_.results(), results_head(study_), comm_));  // where the file is gone
    if (!comm_.is_root()) return agree({}, comm_);
    const auto listed = list_snapshots(folder_.results());
    if (listed.ok()) snapshots = listed->size();
    return agree(listed.ok() ? Status{} : Status(listed.error()), comm_);
  };
  MORULA_TRY(write_results(go_on_with_results));
  if (comm_.any(*events_lost))
    warn(
        "events.jsonl is damaged: some of what happened up to here is lost from it, and criteria, report and lineage know of the rest "
        "alone");
  return tell_what_is_lost(snapshots);
}

Status RunLoop::write_results(const std::function<Status()>& write) {
  Status written = write();
  if (written.ok() || written.error().kind != ErrorKind::kFile) return written;
  MORULA_TRY_ASSIGN(const std::filesystem::path aside, set_aside(folder_.results(), comm_));
  if (aside.empty()) return written;
  warn(written.error().message + "; it is kept as '" + aside.filename().string() +
       "', and the snapshots from here on go into a new results.h5");
  MORULA_TRY(begin_results(folder_.results(), results_head(study_), comm_));
  return write();
}

int RunLoop::wish_to_stop() const {
  std::int64_t wish = request_.stop != nullptr ? request_.stop->load(std::memory_order_relaxed) : kGoOn;
  if (wish == kGoOn && wall() > request_.max_wall) wish = kStopEarly;
  return static_cast<int>(comm_.max(wish));
}

Result<RunSummary> RunLoop::go() {
  RunSummary summary;
  const Clock& clock = simulation_->tissue().clock;
  while (clock.time < end_) {
    if (const int wish = wish_to_stop(); wish != kGoOn) {
      const ErrorKind kind = wish == kInterrupt ? ErrorKind::kInterrupted : ErrorKind::kStoppedEarly;
      if (Status done = finish(RunState::kStopped, kind, summary); !done.ok()) return fail(done.error(), true);
      return summary;
    }
    const std::uint64_t steps = clock.steps;
    const double due = next_output(clock.time, study_.time.output, end_);
    if (Status done = step(due); !done.ok()) {
      if (done.error().kind == ErrorKind::kStoppedEarly) continue;  // broken off by a wish to stop; the state is that before the step
      return fail(done.error(), clock.steps == steps);
    }
    if (clock.time < due) continue;
    if (Status done = output(); !done.ok()) return fail(done.error(), true);
    rested_ = clock.time < end_ && at_rest();
    if (rested_) break;
    if (clock.time < checkpoint_due_ || clock.time >= end_) continue;
    if (Status done = checkpoint(); !done.ok()) return fail(done.error(), true);
  }
  if (Status done = finish(RunState::kDone, ErrorKind::kInternal, summary); !done.ok()) return fail(done.error(), true);
  return summary;
}

bool RunLoop::at_rest() {
  if (!(study_.time.rest > 0.0)) return false;
  const Tissue& tissue = simulation_->tissue();
  double fastest = 0.0;
  for (const auto* velocities : {&tissue.shells.velocity, &tissue.spheres.velocity})
    for (const Vec3f& v : *velocities) fastest = std::max(fastest, static_cast<double>(norm2(v)));
  if (!(std::sqrt(comm_.max(fastest)) < study_.time.rest)) return false;
  const std::vector<std::string> coming = simulation_->still_to_come();
  if (!coming.empty() && coming != awaited_) note(Note::Kind::kNote, "nothing moves, but there is still to come: " + joined(coming));
  awaited_ = coming;
  return coming.empty();
}

Status RunLoop::step(double land_on) {
  const Clock& clock = simulation_->tissue().clock;
  const double before = clock.time;
  const auto began = SteadyClock::now();
  auto made = [&] {
    const OthersTurn others(request_.turn);
    return simulation_->step(land_on, [this] { return wish_to_stop() != kGoOn; });
  }();
  MORULA_TRY_ASSIGN(const StepOutcome outcome, std::move(made));
  interval_.add(outcome);
  ++work_.steps;
  work_.node_steps += load_.nodes;
  work_.cell_steps += static_cast<double>(progress_.cells);
  progress_.step = outcome.mechanics.step;
  keep_events(outcome.events);
  count_cells();
  MORULA_TRY(check_capped_start());
  tell_creeping(outcome);
  tell_progress(clock.time - before, std::chrono::duration<double>(SteadyClock::now() - began).count());
  return {};
}

void RunLoop::count_cells() {
  const Tissue& tissue = simulation_->tissue();
  const std::int64_t spheres = comm_.sum(static_cast<std::int64_t>(tissue.spheres.size()));
  progress_.shells = comm_.sum(static_cast<std::int64_t>(tissue.shells.size()));
  progress_.cells = spheres + progress_.shells;
  progress_.time = tissue.clock.time;
  load_.spheres = static_cast<double>(spheres);
  load_.nodes = static_cast<double>(comm_.sum(static_cast<std::int64_t>(tissue.shells.node_count())));
  load_.shells = static_cast<double>(progress_.shells);
}

void RunLoop::tell_progress(double simulated, double seconds) {
  cost_.observe(simulated, seconds, load_);
  progress_.wall = wall();
  progress_.left = cost_.left(end_ - progress_.time, load_, growth_rate_);
  const double of_outputs = output_seconds_ * std::ceil((end_ - progress_.time) / study_.time.output * (1.0 - 1e-9));
  progress_.left = {progress_.left.low + of_outputs, progress_.left.high + of_outputs};
  if (!comm_.is_root()) return;
  if (request_.on_progress) request_.on_progress(progress_);
  if (SteadyClock::now() - last_status_ < kStatusEvery) return;
  last_status_ = SteadyClock::now();
  const Status written = folder_.write_status(status(RunState::kRunning));
  if (!written.ok() && text_status_.ok()) text_status_ = written;
}

Status RunLoop::output() {
  constexpr double kFade = 0.7;  // memory of about three outputs: they grow with the tissue
  const auto began = SteadyClock::now();
  Measures measures;
  {
    auto timed = simulation_->timer().scope(Stage::kObserve);
    measures = measure(*simulation_);
    expect_growth(measures.of_type);
    MORULA_TRY(write_moment(measures));
  }
  Status within = check_limits(measures);
  MORULA_TRY(agree(write_events(), comm_));  // what the limits warn of belongs to this moment: a checkpoint comes after it
  const double seconds = std::chrono::duration<double>(SteadyClock::now() - began).count();
  output_seconds_ = output_seconds_ > 0.0 ? kFade * output_seconds_ + (1.0 - kFade) * seconds : seconds;
  return within;
}

Status RunLoop::write_moment(const Measures& measures) {
  const Tissue& tissue = simulation_->tissue();
  const CellsAtOutput cells(*simulation_);
  const Moment moment{measures, interval_, tissue.clock, tissue.ledger, cells};
  std::vector<double> row;
  for (const Observable& column : columns_) row.push_back(column.value(moment));
  const Snapshot snapshot = local_snapshot(*simulation_);
  MORULA_TRY(write_results([&] { return append_snapshot(folder_.results(), snapshot, tissue.fields, comm_); }));
  tell_events();
  Status written = std::exchange(text_status_, {});
  if (written.ok()) written = folder_.add_to_series(measures.time, row);
  if (written.ok()) written = write_events();
  if (written.ok()) written = folder_.write_status(status(RunState::kRunning));
  last_output_ = measures.time;
  interval_ = {};
  return agree(std::move(written), comm_);
}

Status RunLoop::write_tables() {
  std::string series, events;
  const auto read = [&]() -> Status {
    MORULA_TRY_ASSIGN(series, read_file(folder_.series()));
    MORULA_TRY_ASSIGN(events, read_file(folder_.events()));
    MORULA_TRY(parse_series(series, folder_.series().string()));  // what is wrong with it is no fault of results.h5
    return {};
  };
  MORULA_TRY(agree(comm_.is_root() ? read() : Status{}, comm_));
  std::map<std::string, std::string> descriptions{{"time", "Simulated time."}};
  for (const Observable& column : columns_) descriptions[column.name] = column.doc;
  return write_results([&] { return write_results_tables(folder_.results(), series, events, descriptions, comm_); });
}

Status RunLoop::checkpoint() {
  auto timed = simulation_->timer().scope(Stage::kObserve);
  const Tissue& tissue = simulation_->tissue();
  checkpoint_due_ = next_multiple(tissue.clock.time, study_.time.checkpoint);
  auto texts = folder_.sync_texts();  // they are on the disk before the checkpoint that counts on them
  MORULA_TRY(agree(texts.ok() ? Status{} : Status(texts.error()), comm_));
  const CheckpointInfo info{record_.study, record_.study_hash, wall_before_ + wall(), {}, warned_, interval_, *texts};
  auto saved = save_checkpoint(folder_.checkpoints(), tissue, info, comm_);
  return saved.ok() ? Status{} : Status(std::move(saved).error());
}

RunStatus RunLoop::status(RunState state) const {
  RunStatus out;
  out.state = state;
  out.time = simulation_->tissue().clock.time;
  out.end = end_;
  out.cells = static_cast<std::uint64_t>(progress_.cells);
  out.shells = static_cast<std::uint64_t>(progress_.shells);
  out.steps = simulation_->tissue().clock.steps;
  out.step = progress_.step;
  out.wall_time = wall_before_ + wall();
  out.left_low = state == RunState::kRunning ? progress_.left.low : -1.0;
  out.left_high = state == RunState::kRunning ? progress_.left.high : -1.0;
  out.process = ::getpid();
  return out;
}

FinalState RunLoop::final_state() const {
  FinalState out;
  out.time = simulation_->tissue().clock.time;
  out.cells = static_cast<std::uint64_t>(progress_.cells);
  out.shells = static_cast<std::uint64_t>(progress_.shells);
  out.spheres = out.cells - out.shells;
  out.state_hash = state_hash(simulation_->tissue(), comm_).hex();
  out.at_rest = rested_;
  return out;
}

Status RunLoop::finish(RunState state, ErrorKind kind, RunSummary& summary) {
  const bool done = state == RunState::kDone;
  if (rested_)
    note(Note::Kind::kNote, "no point moves faster than " + number_text("%.3g um/s", study_.time.rest) +
                                " (`time.rest`): the run ends here, before its " + time_text(end_));
  const std::string how = done ? "" : kind == ErrorKind::kInterrupted ? "interrupted" : "stopped early";
  if (!done) note(Note::Kind::kNote, how + " at " + time_text(progress_.time));
  tell_events();
  Status told = std::exchange(text_status_, {});
  if (told.ok()) told = write_events();
  MORULA_TRY(agree(std::move(told), comm_));
  MORULA_TRY(checkpoint());
  MORULA_TRY(write_tables());
  record_.state = state;
  record_.exit_code = done ? 0 : exit_code(kind);
  record_.message = done ? "" : how + " at " + time_text(progress_.time) + ", with a checkpoint";
  record_.finished = utc_now();
  record_.wall_time = wall_before_ + wall();
  record_.final_state = final_state();
  if (request_.timings) {
    const Timings timings = collect_timings(*simulation_, work_, wall());
    record_.timings = timings_record(timings);
    summary.timings = timings_table(timings);
  }
  Status written = folder_.write_status(status(state));
  if (written.ok() && comm_.is_root() && done) {
    auto outputs = finish_outputs(study_, record_, folder_);
    if (outputs.ok()) {
      record_.message = outputs->judgement.failures();
      record_.exit_code = record_.message.empty() ? 0 : exit_code(ErrorKind::kVerification);
      summary.verdicts = std::move(outputs->judgement.verdicts);
      summary.report = std::move(outputs->report);
    } else {
      written = std::move(outputs).error();
    }
  }
  if (written.ok()) written = folder_.write_record(record_);
  MORULA_TRY(agree(std::move(written), comm_));
  summary.passed = !comm_.any(record_.exit_code == exit_code(ErrorKind::kVerification));
  summary.path = folder_.path();
  summary.state = state;
  if (!done) summary.stopped = kind;
  summary.final_state = *record_.final_state;
  summary.wall_time = wall();
  return {};
}

Error RunLoop::fail(Error error, bool state_is_sound) {
  state_is_sound = state_is_sound && state_is_whole_;
  // A step that broke off midway left no state to keep. Where something could not be written (disk full, folder gone), a checkpoint would be of
  // a moment whose row or snapshot is missing: the run goes on from the earlier one, and writes it then. The error itself comes after the
  // checkpoint: a run that goes on from there tells it anew if it meets it again.
  if (state_is_sound && error.kind == ErrorKind::kPhysics) {
    const bool is_shown = simulation_->tissue().clock.time <= last_output_ || write_moment(measure(*simulation_)).ok();
    if (is_shown && agree(write_events(), comm_).ok()) (void)checkpoint().ok();
  }
  warn(error.message);
  Status events = write_events();
  const bool of_all_ranks = error.kind == ErrorKind::kPhysics;
  if (of_all_ranks && agree(std::move(events), comm_).ok() && write_tables().ok()) {
    if (!error.help.empty()) error.help += "; ";
    error.help += "`morula plot " + shell_word(folder_.path().string()) + "` draws what there is";
  }
  record_.state = RunState::kFailed;
  record_.exit_code = exit_code(error.kind);
  record_.message = error.message;
  record_.finished = utc_now();
  record_.wall_time = wall_before_ + wall();
  if (state_is_sound) record_.final_state = final_state();
  (void)folder_.write_status(status(RunState::kFailed)).ok();
  (void)folder_.write_record(record_).ok();
  error.message = folder_.path().string() + ": " + error.message;
  return error;
}

}  // namespace morula::scenarios
