#include "scenarios/run/driver.h"

#include <algorithm>

#include "results/checkpoint_folder.h"
#include "results/damaged_file.h"
#include "results/file_io.h"
#include "results/observables/select_observables.h"
#include "scenarios/criteria/understand.h"
#include "scenarios/run/report_run.h"
#include "scenarios/run/run_lock.h"
#include "scenarios/run/run_loop.h"
#include "study/initial/make_tissue.h"

namespace morula::scenarios {
namespace {

/// The columns of series.csv: those the study names, then what the criteria of every run and its own are judged on, and its plots show.
Result<std::vector<Observable>> columns_of(const Study& study) {
  std::vector<std::string> names = study.output.series;
  if (!names.empty()) {
    const auto need = [&](const std::string& name) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    const std::vector<std::string> known = observable_names(study.model, *study.laws);
    for (const char* of_every_run : {"cell_count", "shell_count", "volume_error", "overlap", "worst_overlap", "energy", "step_count",
                                     "step_size", "field_balance", "outside_fields", "nucleus_clearance"})
      if (std::find(known.begin(), known.end(), of_every_run) != known.end()) need(of_every_run);
    for (const std::string& of_study : series_columns(study)) need(of_study);
  }
  return select_observables(study.model, *study.laws, names);
}

RunRecord new_record(const Study& study, const RunRequest& request, const Comm& comm) {
  RunRecord record;
  record.study = study.name;
  record.title = study.title;
  record.seed = study.model.seed;
  record.ranks = comm.size();
  record.threads = request.threads;
  record.command = request.command;
  complete_record(record);
  return record;
}

Result<InitialTissue> initial_tissue(const Study& study, const Comm& comm, int threads) {
  ShapeLibrary shapes;
  auto made = make_tissue(study, shapes, comm, threads);
  MORULA_TRY(agree(made.ok() ? Status{} : Status(made.error()), comm));
  return std::move(made).value();
}

/// Tell the study's warnings and notes, and what placing the cells had to say.
void tell(RunLoop& loop, const Study& study, const RunRequest& request, const std::vector<std::string>& more) {
  for (const std::string& text : request.warnings) loop.note(Note::Kind::kWarning, text);
  for (const Diagnostic& warning : study.warnings.list()) loop.note(Note::Kind::kWarning, warning.text);
  for (const std::string& text : study.notes) loop.note(Note::Kind::kNote, text);
  for (const std::string& text : more)
    if (std::find(study.notes.begin(), study.notes.end(), text) == study.notes.end()) loop.note(Note::Kind::kNote, text);
}

std::string end_note(const RunRequest& request, double end) {
  return "--until " + time_text(*request.until) + ": runs to " + time_text(end) + (end > *request.until ? ", the next output time" : "");
}

/// series.csv and run.json as they were when the run was last written.
struct Restored {
  LoadedCheckpoint checkpoint;
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> damaged;  ///< newer checkpoints that could not be used
};

Result<Restored> restore(const RunFolder& folder, const ResumeRequest& request, const Study& study, const Comm& comm) {
  ShapeLibrary shapes;
  Restored out;
  if (!request.from.empty()) {
    MORULA_TRY_ASSIGN(out.checkpoint, read_checkpoint(request.from, study.model, shapes, comm));
  } else {
    MORULA_TRY_ASSIGN(RestoredCheckpoint newest, load_newest_checkpoint(folder.checkpoints(), study.model, shapes, comm));
    out.checkpoint = std::move(newest.checkpoint);
    out.warnings = std::move(newest.warnings);
    out.damaged = std::move(newest.damaged);
  }
  return out;
}

/// Takes damaged checkpoints out of the row: of those that are kept both must be usable.
Status set_aside_damaged(Restored& restored, const Comm& comm) {
  for (const std::filesystem::path& path : restored.damaged) {
    MORULA_TRY_ASSIGN(const std::filesystem::path aside, set_aside(path, comm));
    if (!aside.empty()) restored.warnings.push_back("'" + path.filename().string() + "' is kept as '" + aside.filename().string() + "'");
  }
  return {};
}

/// The copies of the files that the study reads are those that the run began with.
Status check_inputs(const std::filesystem::path& run, const RunRecord& record) {
  for (const InputRecord& input : record.inputs) {
    if (input.copy == "study.yaml") continue;  // the resolved one counts
    MORULA_TRY_ASSIGN(const std::string now, sha256_of_file(run / input.copy));
    if (now != input.sha256)
      return Error{ErrorKind::kInput, "'" + (run / input.copy).string() + "' is not what the run began with",
                   "the copies in `inputs` must not be changed; start a new run instead"};
  }
  return {};
}

/// An error where the run is later than the time that it is asked to go to.
Status is_before(double time, double wanted, const char* key) {
  if (wanted >= time) return {};
  return Error{ErrorKind::kInput, "the run is at " + time_text(time) + " already, later than " + key + ' ' + time_text(wanted),
               "give a later time, or `--from` an earlier checkpoint"};
}

/// What a checkpoint knows by number must have the same numbers in the study that goes on from it; and what lies on a grid must keep the grid.
Status can_go_on(const Study& parent, const Study& study) {
  const auto differs = [](const std::string& what) {
    return Error{ErrorKind::kInput,
                 "the run that goes on has other " + what + " than the one that it goes on from, or has them in another order",
                 "keep them as they are; types, obstacles and lumens that are new come last"};
  };
  const auto begins_alike = [](const auto& before, const auto& now) {
    return before.size() <= now.size() &&
           std::equal(before.begin(), before.end(), now.begin(), [](const auto& a, const auto& b) { return a.name == b.name; });
  };
  const Model &was = parent.model, &is = study.model;
  if (!begins_alike(was.types, is.types)) return differs("cell types");
  for (std::size_t t = 0; t < was.types.size(); ++t) {
    const CellType &before = was.types[t], &now = is.types[t];
    const auto same_name = [](const CyclePhase& a, const CyclePhase& b) { return a.name == b.name; };
    if (!std::ranges::equal(before.cycle.phases, now.cycle.phases, same_name))
      return differs("phases of the cycle of '" + before.name + "'");
    if (before.shell_nodes != now.shell_nodes) return differs("nodes of the shells of '" + before.name + "'");
  }
  if (!begins_alike(was.obstacles, is.obstacles)) return differs("obstacles");
  if (!begins_alike(was.lumens, is.lumens)) return differs("lumens");
  if (!begins_alike(was.fields, is.fields)) return differs("fields");
  for (std::size_t f = 0; f < was.fields.size(); ++f)
    if (was.fields[f].voxel != is.fields[f].voxel) return differs("voxels");
  const Box &a = was.space.box, &b = is.space.box;
  if (!was.fields.empty() && (norm2(a.low - b.low) > 0.0 || norm2(a.high - b.high) > 0.0))
    return differs("bounds of the domain, in which fields lie,");
  return {};
}

/// Whether the checkpoint is of the study in this folder; `otherwise` if not.
Status is_of_run(const RunFolder& folder, const Restored& restored, Error otherwise) {
  MORULA_TRY_ASSIGN(const std::string study_hash, sha256_of_file(folder.resolved_study()));
  return restored.checkpoint.info.study_hash == study_hash ? Status{} : Status(std::move(otherwise));
}

}  // namespace

Result<RunSummary> run(const Study& study, const RunRequest& request, const Comm& comm) {
  MORULA_TRY_ASSIGN(auto columns, columns_of(study));
  MORULA_TRY_ASSIGN(InitialTissue initial, initial_tissue(study, comm, request.threads));
  MORULA_TRY_ASSIGN(auto simulation, Simulation::create(study.model, std::move(initial.tissue), comm, request.threads));
  MORULA_TRY_ASSIGN(RunFolder folder, RunFolder::create(request.runs, request.out, study.name, comm));
  MORULA_TRY_ASSIGN(const RunLock lock, RunLock::take(folder.path(), comm));
  RunRecord record = new_record(study, request, comm);
  Status written = folder.write_study(study, record);
  if (written.ok()) written = folder.write_record(record);
  MORULA_TRY(agree(std::move(written), comm));
  if (comm.is_root() && request.on_start) request.on_start(folder.path());
  RunLoop loop(study, request, comm, std::move(folder), std::move(columns), std::move(record), std::move(simulation));
  tell(loop, study, request, initial.notes);
  if (request.until) loop.note(Note::Kind::kNote, end_note(request, loop.end()));
  if (Status begun = loop.begin(); !begun.ok()) return loop.fail(begun.error(), true);
  return loop.go();
}

Result<RunSummary> resume(const std::filesystem::path& run, const ResumeRequest& asked, const Comm& comm) {
  MORULA_TRY_ASSIGN(RunFolder folder, RunFolder::open(run, comm));
  MORULA_TRY_ASSIGN(const RunLock lock, RunLock::take(folder.path(), comm));
  auto read = read_run_study(folder.path(), asked.laws);
  MORULA_TRY(agree(read.ok() ? Status{} : Status(read.error()), comm));
  const Study study = std::move(read).value();
  ResumeRequest request = asked;
  // A run that was to go beyond the study's end still is.
  const auto was = read_run_status(folder.status());
  if (const double end = comm.max(was.ok() ? was->end : 0.0); !asked.until && end > study.time.end) request.until = end;
  MORULA_TRY_ASSIGN(RunRecord record, read_run_record(folder.record()));
  MORULA_TRY_ASSIGN(auto columns, columns_of(study));
  MORULA_TRY_ASSIGN(Restored restored, restore(folder, request, study, comm));
  MORULA_TRY(is_of_run(folder, restored,
                       {ErrorKind::kInput, "the checkpoint belongs to another study than '" + folder.resolved_study().string() + "'",
                        "the resolved study of a run must not be changed; start a new run instead"}));
  MORULA_TRY(agree(comm.is_root() ? check_inputs(folder.path(), record) : Status{}, comm));
  const double time = restored.checkpoint.tissue.clock.time;
  if (asked.until) MORULA_TRY(is_before(time, *asked.until, "--until"));
  MORULA_TRY(set_aside_damaged(restored, comm));
  const std::string failure = record.state == RunState::kFailed ? record.message : "";
  MORULA_TRY_ASSIGN(auto simulation, Simulation::create(study.model, std::move(restored.checkpoint.tissue), comm, request.threads));
  record.state = RunState::kRunning;
  record.message.clear();
  record.finished.clear();
  record.final_state.reset();
  record.ranks = comm.size();
  record.threads = request.threads;
  record.wall_time = restored.checkpoint.info.wall_time;
  complete_record(record);
  MORULA_TRY(agree(folder.write_record(record), comm));
  if (comm.is_root() && request.on_start) request.on_start(folder.path());
  RunLoop loop(study, request, comm, std::move(folder), std::move(columns), std::move(record), std::move(simulation));
  // First what lies beyond the checkpoint goes, from the log too; then the log says so.
  if (Status back = loop.go_back(restored.checkpoint.info); !back.ok()) return loop.fail(back.error(), false);
  for (const std::string& warning : request.warnings) loop.note(Note::Kind::kWarning, warning);
  for (const std::string& warning : restored.warnings) loop.note(Note::Kind::kWarning, warning);
  loop.note(Note::Kind::kNote, "resumed from the checkpoint at " + time_text(time));
  if (!failure.empty()) loop.note(Note::Kind::kWarning, "the run had ended with an error, and goes on unchanged: " + failure);
  if (time >= loop.end()) loop.note(Note::Kind::kNote, "nothing is left to do: the run ends at " + time_text(loop.end()));
  if (asked.until) loop.note(Note::Kind::kNote, end_note(request, loop.end()));
  return loop.go();
}

Result<RunSummary> branch(const std::filesystem::path& parent, const Study& study, const ResumeRequest& request, const Comm& comm) {
  MORULA_TRY_ASSIGN(const RunFolder from, RunFolder::open(parent, comm));
  MORULA_TRY_ASSIGN(auto columns, columns_of(study));
  auto parent_study = read_run_study(from.path(), request.laws);
  MORULA_TRY(agree(parent_study.ok() ? Status{} : Status(parent_study.error()), comm));
  MORULA_TRY(agree(can_go_on(*parent_study, study), comm));
  MORULA_TRY_ASSIGN(Restored restored, restore(from, request, study, comm));
  const double time = restored.checkpoint.tissue.clock.time;
  MORULA_TRY(agree(request.until ? is_before(time, *request.until, "--until") : is_before(time, study.time.end, "`time.end`"), comm));
  MORULA_TRY(is_of_run(from, restored,
                       {ErrorKind::kInput, "the checkpoint belongs to another run than '" + from.path().string() + "'",
                        "give `--from` a checkpoint of that run"}));
  MORULA_TRY_ASSIGN(auto simulation, Simulation::create(study.model, std::move(restored.checkpoint.tissue), comm, request.threads));
  MORULA_TRY_ASSIGN(RunFolder folder, RunFolder::create(request.runs, request.out, study.name, comm));
  MORULA_TRY_ASSIGN(const RunLock lock, RunLock::take(folder.path(), comm));
  RunRecord record = new_record(study, request, comm);
  record.parent = std::filesystem::absolute(from.path()).lexically_normal().string();
  Status written = folder.write_study(study, record);
  if (written.ok()) written = folder.write_record(record);
  MORULA_TRY(agree(std::move(written), comm));
  if (comm.is_root() && request.on_start) request.on_start(folder.path());
  RunLoop loop(study, request, comm, std::move(folder), std::move(columns), std::move(record), std::move(simulation));
  tell(loop, study, request, restored.warnings);
  loop.note(Note::Kind::kNote, "goes on from '" + from.path().string() + "' at " + time_text(time));
  if (request.until) loop.note(Note::Kind::kNote, end_note(request, loop.end()));
  if (Status begun = loop.begin(); !begun.ok()) return loop.fail(begun.error(), true);
  return loop.go();
}

}  // namespace morula::scenarios
