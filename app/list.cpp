#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/run_state.h"
#include "app/verbs.h"
#include "app/words.h"
#include "results/file_io.h"
#include "results/run_files.h"
#include "scenarios/run/progress.h"

namespace morula::app {
namespace fs = std::filesystem;
namespace {

Result<std::vector<RunOverview>> runs_in(const fs::path& folder, const Context& context) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code missing;
    if (fs::exists(scenarios::RunFiles(entry->path()).record(), missing)) paths.push_back(entry->path());
  }
  if (error) return scenarios::file_error(folder, "read", error.value());
  std::sort(paths.begin(), paths.end());
  std::vector<RunOverview> runs;
  for (const fs::path& path : paths) {
    auto run = overview_of(path);
    if (run.ok())
      runs.push_back(std::move(run).value());
    else
      context.console.warning(run.error().message);  // one damaged run does not hide the others
  }
  return runs;
}

std::string json_of(const std::vector<RunOverview>& runs) {
  auto list = nlohmann::ordered_json::array();
  for (const RunOverview& run : runs)
    list.push_back({{"run", run.path.string()},
                    {"study", run.record.study},
                    {"state", run.state_word()},
                    {"time", run.status.time},
                    {"end", run.status.end},
                    {"cells", run.status.cells},
                    {"shells", run.status.shells},
                    {"seed", run.record.seed},
                    {"ranks", run.record.ranks},
                    {"threads", run.record.threads},
                    {"wall_time", run.status.wall_time},
                    {"started", run.record.started},
                    {"parent", run.record.parent}});
  return list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

Status list(const ListOptions& options, const Context& context) {
  std::error_code error;
  const fs::path folder = !options.folder.empty()           ? fs::path(options.folder)
                          : fs::is_directory("runs", error) ? fs::path("runs")
                                                            : fs::path(".");
  if (!fs::is_directory(folder, error))
    return Error{ErrorKind::kFile, "'" + folder.string() + "' is no folder", "give the folder that holds the runs, as `morula list runs`"};
  MORULA_TRY_ASSIGN(const std::vector<RunOverview> runs, runs_in(folder, context));
  if (options.json) {
    context.console.result(json_of(runs));
    return {};
  }
  if (runs.empty()) {
    context.console.note("no runs in '" + folder.string() + "'");
    return {};
  }
  std::vector<std::vector<std::string>> rows{{"run", "state", "time", "of", "cells", "shells", "wall", "started"}};
  for (const RunOverview& run : runs)
    rows.push_back({run.path.filename().string(), run.state_word(), scenarios::time_text(run.status.time),
                    scenarios::time_text(run.status.end), std::to_string(run.status.cells), std::to_string(run.status.shells),
                    scenarios::duration_text(run.status.wall_time), run.record.started});
  context.console.result(table_text(rows));
  return {};
}

}  // namespace morula::app
