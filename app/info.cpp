#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/laws.h"
#include "app/read_study.h"
#include "app/run_state.h"
#include "app/verbs.h"
#include "app/words.h"
#include "core/numbers/joined.h"
#include "results/checkpoint_folder.h"
#include "results/file_io.h"
#include "results/run_folder.h"
#include "results/state_hash.h"
#include "scenarios/run/progress.h"
#include "study/catalogue.h"
#include "study/diagnostics.h"

namespace morula::app {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
namespace {

std::string text_of(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

/// The Tissue of the newest good checkpoint of a run, counted and hashed; nothing if there is no checkpoint yet.
Result<scenarios::FinalState> newest_state(const scenarios::RunFolder& run, const Context& context) {
  const Comm alone;
  const auto study = scenarios::read_study(run.resolved_study(), {.laws = context.laws, .judge_places = false});
  if (!study.ok()) return study.error().as_error();
  ShapeLibrary shapes;
  MORULA_TRY_ASSIGN(const scenarios::RestoredCheckpoint restored,
                    scenarios::load_newest_checkpoint(run.checkpoints(), study->model, shapes, alone));
  for (const std::string& warning : restored.warnings) context.console.warning(warning);
  const Tissue& tissue = restored.checkpoint.tissue;
  return scenarios::FinalState{tissue.clock.time,
                               tissue.cells.size(),
                               tissue.spheres.size(),
                               tissue.shells.size(),
                               scenarios::state_hash(tissue, alone).hex(),
                               false};
}

Json json_of(const RunOverview& run, const scenarios::FinalState& state) {
  Json json = Json::parse(scenarios::to_json(run.record));
  Json out{{"run", run.path.string()},       {"state", run.state_word()}, {"time", state.time},
           {"cells", state.cells},           {"spheres", state.spheres},  {"shells", state.shells},
           {"state_hash", state.state_hash}, {"end", run.status.end},     {"steps", run.status.steps}};
  for (const auto& [key, value] : json.items())
    if (!out.contains(key)) out[key] = value;
  return out;
}

std::string text_of(const RunOverview& run, const scenarios::FinalState& state) {
  const scenarios::RunRecord& r = run.record;
  std::string out = run.path.string() + ": " + r.study + (r.title.empty() ? "" : ", " + r.title) + "\n";
  out += "  state     " + run.state_word() + (r.message.empty() ? "" : ": " + r.message) + "\n";
  out += "  time      " + scenarios::time_text(state.time) + (state.at_rest ? ", at rest," : "") +
         (run.status.end > 0.0 ? " of " + scenarios::time_text(run.status.end) : "") + "\n";
  out += "  cells     " + std::to_string(state.cells) + " (" + count_words(state.spheres, "sphere", "spheres") + ", " +
         count_words(state.shells, "shell", "shells") + ")\n";
  out += "  hash      " + state.state_hash + "\n";
  out += "  seed      " + std::to_string(r.seed) + "\n";
  out += "  ran on    " + r.host + ", " + count_words(static_cast<std::uint64_t>(r.ranks), "rank", "ranks") + ", " +
         count_words(static_cast<std::uint64_t>(r.threads), "thread", "threads") + " each, " + scenarios::duration_text(r.wall_time) + "\n";
  out += "  morula    " + r.version + " (" + r.git_hash + "), " + r.compiler + "\n";
  out += "  command   " + r.command + "\n";
  if (!r.parent.empty()) out += "  parent    " + r.parent + "\n";
  for (const scenarios::InputRecord& input : r.inputs)
    out += "  input     " + input.source + " (sha256 " + input.sha256.substr(0, 16) + "...)\n";
  return out;
}

Status info_of_run(const InfoOptions& options, const Context& context) {
  MORULA_TRY_ASSIGN(const scenarios::RunFolder folder, scenarios::RunFolder::open(options.target, Comm()));
  if (options.defaults) {
    MORULA_TRY_ASSIGN(const std::string resolved, scenarios::read_file(folder.resolved_study()));
    context.console.result(resolved);
    return {};
  }
  MORULA_TRY_ASSIGN(const RunOverview run, overview_of(options.target));
  // The record keeps the state at the end; a run that was killed has none, and its newest checkpoint is what a resume would start from.
  scenarios::FinalState state;
  if (run.record.final_state && run.record.state != scenarios::RunState::kRunning) {
    state = *run.record.final_state;
  } else if (auto found = newest_state(folder, context); found.ok()) {
    state = std::move(found).value();
  } else {
    context.console.warning(found.error().message);
    state = {run.status.time, run.status.cells, run.status.cells - run.status.shells, run.status.shells, ""};
  }
  context.console.result(options.json ? text_of(json_of(run, state)) : text_of(run, state));
  return {};
}

Status info_of_study(const InfoOptions& options, const Context& context) {
  MORULA_TRY_ASSIGN(const scenarios::Study study, read_study_and_tell(options.target, {}, false, context));
  if (options.defaults) {
    context.console.result(study.resolved_text);
    return {};
  }
  const Model& model = study.model;
  std::uint64_t cells = 0;
  for (const scenarios::InitialCells& block : study.initial) cells += block.count;
  Json types = Json::array(), obstacles = Json::array(), fields = Json::array(), regions = Json::array();
  for (const CellType& type : model.types) types.push_back(type.name);
  for (const ObstacleSpec& obstacle : model.obstacles) obstacles.push_back(obstacle.name);
  for (const fields::FieldSpec& field : model.fields) fields.push_back(field.name);
  for (const Region& region : model.swaps.regions) regions.push_back(region.name);
  const Json json{{"study", study.name},   {"title", study.title}, {"scenario", study.scenario}, {"seed", model.seed},
                  {"end", study.time.end}, {"cells", cells},       {"cell_types", types},        {"obstacles", obstacles},
                  {"fields", fields},      {"regions", regions}};
  if (options.json) {
    context.console.result(text_of(json));
    return {};
  }
  const auto names = [](const Json& list) {
    return list.empty() ? std::string("none") : joined(list, [](const Json& name) { return name.get<std::string>(); });
  };
  context.console.result(study.name + (study.title.empty() ? "" : ": " + study.title) + "\n  end         " +
                         scenarios::time_text(study.time.end) + "\n  seed        " + std::to_string(model.seed) + "\n  cells       " +
                         std::to_string(cells) + "\n  cell types  " + names(types) + "\n  obstacles   " + names(obstacles) +
                         "\n  fields      " + names(fields) + "\n  regions     " + names(regions) + "\n");
  return {};
}

void add_defaults(const scenarios::Declaration& from, std::vector<std::vector<std::string>>& rows) {
  for (const scenarios::Declaration& key : from.children) {
    if (key.spec.fallback && *key.spec.fallback) rows.push_back({key.path, key.spec.fallback, key.spec.source});
    add_defaults(key, rows);
  }
}

/// Every key that has a default, with the default and where it comes from.
Status info_of_defaults(const InfoOptions& options, const Context& context) {
  std::vector<std::vector<std::string>> rows;
  add_defaults(scenarios::study_declarations(*context.laws), rows);
  if (options.json) {
    Json list = Json::array();
    for (const auto& row : rows) list.push_back({{"key", row[0]}, {"default", row[1]}, {"source", row[2]}});
    context.console.result(text_of(list));
    return {};
  }
  rows.insert(rows.begin(), {"key", "default", "source"});
  context.console.result(table_text(rows));
  return {};
}

}  // namespace

Status info(const InfoOptions& options, const Context& context) {
  if (options.target.empty()) return info_of_defaults(options, context);
  std::error_code error;
  if (fs::is_directory(options.target, error)) return info_of_run(options, context);
  if (fs::exists(options.target, error)) return info_of_study(options, context);
  const std::vector<ListedLaw> laws = laws_named(*context.laws, options.target);
  if (!laws.empty()) {
    for (const ListedLaw& law : laws) context.console.result(options.json ? law_json(law) : law_text(law));
    return {};
  }
  const std::string near = scenarios::suggest(options.target, law_names(*context.laws));
  const bool suggestion = near.rfind("did you mean", 0) == 0;
  return Error{ErrorKind::kFile, "'" + options.target + "' is no run folder, no study file and no law",
               suggestion ? near : "`morula list` shows the runs; `morula explain --markdown laws` the laws"};
}

}  // namespace morula::app
