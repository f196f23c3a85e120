#include <filesystem>

#include "app/read_study.h"
#include "app/run_display.h"
#include "app/run_request.h"
#include "app/signals.h"
#include "app/verbs.h"
#include "core/numbers/joined.h"
#include "results/checkpoint_folder.h"
#include "results/file_io.h"
#include "results/run_folder.h"

namespace morula::app {
namespace fs = std::filesystem;
namespace {

/// The checkpoint the user names: a path, or a file name in the run with or without its ending.
Result<fs::path> find_checkpoint(const fs::path& run, const std::string& from) {
  std::error_code error;
  const fs::path folder = scenarios::RunFiles(run).checkpoints();
  for (const fs::path& path : {folder / from, folder / (from + ".h5"), fs::path(from)})
    if (fs::is_regular_file(path, error)) return path;
  const std::string there = joined(scenarios::checkpoints_in(folder), [](const fs::path& path) { return path.stem().string(); });
  return Error{ErrorKind::kFile, "there is no checkpoint '" + from + "' in '" + run.string() + "'",
               there.empty() ? "the run has no checkpoints" : "there are: " + there};
}

bool is_newest(const fs::path& run, const fs::path& checkpoint) {
  const auto all = scenarios::checkpoints_in(scenarios::RunFiles(run).checkpoints());
  std::error_code error;
  return !all.empty() && fs::equivalent(all.front(), checkpoint, error);
}

}  // namespace

Status resume(const ResumeOptions& options, const Context& context) {
  outlive_closed_pipes();
  MORULA_TRY_ASSIGN(const scenarios::RunFolder folder, scenarios::RunFolder::open(options.run, context.comm));
  auto study = read_study_and_tell(folder.resolved_study().string(), options.overrides, false, context, {.judge_places = false});
  MORULA_TRY(agree_on(study, folder.resolved_study().string(), context));
  for (const std::string& change : options.overrides) {
    const std::string key = change.substr(0, change.find('='));
    if (key == "initial" || key.starts_with("initial.") || (key.starts_with("fields.") && key.ends_with(".initial")))
      return Error{ErrorKind::kInput, "`" + key + "` says how a run begins, and this one has begun", "start a new run with `morula run`"};
    if (key.starts_with("cell_types.") && (key.ends_with(".body") || key.ends_with(".radius") || key.find(".radius.") != std::string::npos))
      context.console.note("`" + key + "` is of cells that begin: those that the run has keep theirs");
  }
  scenarios::ResumeRequest request;
  request.laws = context.laws;
  MORULA_TRY(fill_request(options.limits, context, request));
  bool go_back = false;
  if (!options.from.empty()) {
    auto found = find_checkpoint(folder.path(), options.from);
    MORULA_TRY(scenarios::agree(found.ok() ? Status{} : Status{found.error()}, context.comm));
    request.from = std::move(found).value();
    go_back = !options.out.empty() || !is_newest(folder.path(), request.from);
  }
  RunDisplay display(context.console, first_line(*study, options.limits.threads, context));
  display.listen_to(request);
  // A change of the study, or going on from an earlier moment, makes a new run: what the old one has found stays.
  const bool new_run = !options.overrides.empty() || go_back;
  if (new_run) {
    request.out = options.out;
    request.runs = fs::absolute(folder.path()).lexically_normal().parent_path();
  }
  MORULA_TRY_ASSIGN(const scenarios::RunSummary summary, new_run ? scenarios::branch(folder.path(), *study, request, context.comm)
                                                                 : scenarios::resume(folder.path(), request, context.comm));
  display.end(summary);
  return outcome_of(summary);
}

}  // namespace morula::app
