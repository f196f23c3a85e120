#include <nlohmann/json.hpp>

#include "app/run_state.h"
#include "app/verbs.h"
#include "app/words.h"
#include "core/numbers/number_text.h"
#include "core/shell_word.h"
#include "results/checkpoint_folder.h"
#include "results/run_folder.h"
#include "scenarios/run/progress.h"

namespace morula::app {
namespace {

using scenarios::RunState;
using scenarios::RunStatus;

std::string status_text(const RunOverview& run) {
  const RunStatus& status = run.status;
  const double part = status.end > 0.0 ? 100.0 * status.time / status.end : 0.0;
  std::string out = run.path.string() + ": " + run.state_word() + "\n";
  const bool at_rest = run.record.final_state && run.record.final_state->at_rest;
  out += "  time   " + scenarios::time_text(status.time) + (at_rest ? ", at rest," : "") + " of " + scenarios::time_text(status.end) +
         " (" + number_text("%.0f", part) + " %)\n";
  out += "  cells  " + std::to_string(status.cells) + " (" + count_words(status.shells, "shell", "shells") + ")\n";
  out += "  steps  " + std::to_string(status.steps) + ", the last of " + number_text("%.3g s", status.step) + "\n";
  out += "  wall   " + scenarios::duration_text(status.wall_time);
  if (status.state == RunState::kRunning && !run.lost && status.left_low >= 0.0)
    out += ", left " + scenarios::duration_text(status.left_low) + " to " + scenarios::duration_text(status.left_high);
  out += "\n  as of  " + status.updated + "\n";
  if (!run.record.message.empty()) out += "  why    " + run.record.message + "\n";
  if (run.lost && scenarios::checkpoints_in(scenarios::RunFiles(run.path).checkpoints()).empty())
    out += "  next   it came to no checkpoint; begin again: " + run.record.command + "\n";
  else if (run.lost || status.state == RunState::kStopped)
    out += "  next   morula resume " + shell_word(run.path.string()) + " --until " + number_text("%.15g", status.end) + "s\n";
  return out;
}

}  // namespace

Status show_status(const StatusOptions& options, const Context& context) {
  MORULA_TRY_ASSIGN(const RunOverview run, overview_of(options.run));
  if (!options.json) {
    context.console.result(status_text(run));
    return {};
  }
  auto json = nlohmann::ordered_json::parse(scenarios::to_json(run.status));
  json["state"] = run.state_word();
  json["run"] = run.path.string();
  context.console.result(json.dump(2) + "\n");
  return {};
}

}  // namespace morula::app
