#include "results/run_record.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/numbers/joined.h"
#include "core/numbers/number_text.h"
#include "coupling/model.h"
#include "results/build_info.h"
#include "results/file_io.h"

namespace morula::scenarios {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::array kStates{RunState::kRunning, RunState::kDone, RunState::kStopped, RunState::kFailed};

/// Exit code of a run that could leave nothing but its mark (exit_code.h: kResources).
constexpr int kFullDisk = 6;

/// Text of a document; bytes that are not UTF-8 are replaced, not an error.
std::string text_of(const Json& json, int indent) { return json.dump(indent, ' ', false, Json::error_handler_t::replace) + '\n'; }

/// JSON has no infinities: they become null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string text_at(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}
template <class T>
T number_at(const Json& json, const char* key, T fallback) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<T>() : fallback;
}

std::optional<RunState> state_at(const Json& json) {
  for (const RunState state : kStates)
    if (name_of(state) == text_at(json, "state")) return state;
  return std::nullopt;
}

Result<Json> read_object(const std::filesystem::path& path) {
  MORULA_TRY_ASSIGN(const std::string text, read_file(path));
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !state_at(json))
    return Error{ErrorKind::kFile, "'" + path.string() + "' is damaged: not a record of a run",
                 "a status.json may be deleted, the next output writes it anew; without run.json a run cannot go on, but "
                 "study.resolved.yaml beside it can be run anew"};
  return json;
}

}  // namespace

std::string name_of(RunState state) {
  switch (state) {
    case RunState::kRunning:
      return "running";
    case RunState::kDone:
      return "done";
    case RunState::kStopped:
      return "stopped";
    case RunState::kFailed:
      return "failed";
  }
  return "failed";
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

void complete_record(RunRecord& record) {
  const BuildInfo build = build_info();
  record.version = build.version;
  record.git_hash = build.git_hash;
  record.compiler = build.compiler;
  record.build_type = build.build_type;
  record.libraries = build.libraries;
  char host[256] = "";
  ::gethostname(host, sizeof host - 1);
  record.host = host;
  if (record.started.empty()) record.started = utc_now();
}

std::string to_json(const RunRecord& r) {
  Json json;
  json["state"] = name_of(r.state);
  json["exit_code"] = r.state == RunState::kRunning ? Json(nullptr) : Json(r.exit_code);
  json["message"] = r.message;
  json["study"] = r.study;
  json["title"] = r.title;
  json["seed"] = r.seed;
  json["ranks"] = r.ranks;
  json["threads"] = r.threads;
  json["command"] = r.command;
  json["parent"] = r.parent.empty() ? Json(nullptr) : Json(r.parent);
  json["started"] = r.started;
  json["finished"] = r.finished.empty() ? Json(nullptr) : Json(r.finished);
  json["wall_time_s"] = number(r.wall_time);
  if (r.final_state) {
    json["final"] = {{"time_s", number(r.final_state->time)},   {"cells", r.final_state->cells},
                     {"spheres", r.final_state->spheres},       {"shells", r.final_state->shells},
                     {"state_hash", r.final_state->state_hash}, {"at_rest", r.final_state->at_rest}};
  }
  if (!r.timings.empty()) {
    json["timings"] = Json::object();
    for (const auto& [name, value] : r.timings) json["timings"][name] = number(value);
  }
  json["study_hash"] = r.study_hash;
  json["inputs"] = Json::array();
  for (const InputRecord& input : r.inputs)
    json["inputs"].push_back({{"source", input.source}, {"copy", input.copy}, {"sha256", input.sha256}});
  json["version"] = r.version;
  json["git_hash"] = r.git_hash;
  json["compiler"] = r.compiler;
  json["build"] = r.build_type;
  json["libraries"] = Json::object();
  for (const auto& [name, version] : r.libraries) json["libraries"][name] = version;
  json["host"] = r.host;
  return text_of(json, 2);
}

Result<RunRecord> read_run_record(const std::filesystem::path& run_json) {
  MORULA_TRY_ASSIGN(const Json json, read_object(run_json));
  RunRecord r;
  r.state = *state_at(json);
  r.exit_code = number_at(json, "exit_code", 0);
  r.message = text_at(json, "message");
  std::error_code ignored;
  if (r.state == RunState::kRunning && std::filesystem::exists(run_json.parent_path() / "FAILED", ignored)) {
    r.state = RunState::kFailed;
    r.exit_code = kFullDisk;
    r.message = "the disk was too full to say why";
  }
  r.study = text_at(json, "study");
  r.title = text_at(json, "title");
  r.seed = number_at(json, "seed", std::uint64_t{0});
  r.ranks = number_at(json, "ranks", 1);
  r.threads = number_at(json, "threads", 1);
  r.command = text_at(json, "command");
  r.parent = text_at(json, "parent");
  r.started = text_at(json, "started");
  r.finished = text_at(json, "finished");
  r.wall_time = number_at(json, "wall_time_s", 0.0);
  r.study_hash = text_at(json, "study_hash");
  r.version = text_at(json, "version");
  r.git_hash = text_at(json, "git_hash");
  r.compiler = text_at(json, "compiler");
  r.build_type = text_at(json, "build");
  r.host = text_at(json, "host");
  if (const auto final = json.find("final"); final != json.end() && final->is_object())
    r.final_state = FinalState{number_at(*final, "time_s", 0.0),
                               number_at(*final, "cells", std::uint64_t{0}),
                               number_at(*final, "spheres", std::uint64_t{0}),
                               number_at(*final, "shells", std::uint64_t{0}),
                               text_at(*final, "state_hash"),
                               final->value("at_rest", Json(false)) == Json(true)};
  if (const auto timings = json.find("timings"); timings != json.end() && timings->is_object())
    for (const auto& [name, value] : timings->items())
      if (value.is_number()) r.timings.emplace_back(name, value.get<double>());
  if (const auto inputs = json.find("inputs"); inputs != json.end() && inputs->is_array())
    for (const Json& input : *inputs)
      if (input.is_object()) r.inputs.push_back({text_at(input, "source"), text_at(input, "copy"), text_at(input, "sha256")});
  if (const auto libraries = json.find("libraries"); libraries != json.end() && libraries->is_object())
    for (const auto& [name, version] : libraries->items())
      if (version.is_string()) r.libraries.emplace_back(name, version.get<std::string>());
  return r;
}

std::string to_json(const RunStatus& s) {
  const Json json{{"state", name_of(s.state)},
                  {"time_s", number(s.time)},
                  {"end_s", number(s.end)},
                  {"fraction", number(s.end > 0 ? std::min(1.0, s.time / s.end) : 0.0)},
                  {"cells", s.cells},
                  {"shells", s.shells},
                  {"steps", s.steps},
                  {"step_s", number(s.step)},
                  {"wall_time_s", number(s.wall_time)},
                  {"left_low_s", s.left_low < 0 ? Json(nullptr) : number(s.left_low)},
                  {"left_high_s", s.left_high < 0 ? Json(nullptr) : number(s.left_high)},
                  {"process", s.process},
                  {"updated", s.updated.empty() ? utc_now() : s.updated}};
  return text_of(json, 2);
}

Result<RunStatus> read_run_status(const std::filesystem::path& status_json) {
  MORULA_TRY_ASSIGN(const Json json, read_object(status_json));
  RunStatus s;
  s.state = *state_at(json);
  s.time = number_at(json, "time_s", 0.0);
  s.end = number_at(json, "end_s", 0.0);
  s.cells = number_at(json, "cells", std::uint64_t{0});
  s.shells = number_at(json, "shells", std::uint64_t{0});
  s.steps = number_at(json, "steps", std::uint64_t{0});
  s.step = number_at(json, "step_s", 0.0);
  s.wall_time = number_at(json, "wall_time_s", 0.0);
  s.left_low = number_at(json, "left_low_s", -1.0);
  s.left_high = number_at(json, "left_high_s", -1.0);
  s.process = number_at(json, "process", std::int64_t{0});
  s.updated = text_at(json, "updated");
  return s;
}

std::string name_of(EventKind kind) {
  switch (kind) {
    case EventKind::kDivision:
      return "division";
    case EventKind::kDivisionWaits:
      return "division_waits";
    case EventKind::kDeath:
      return "death";
    case EventKind::kRemoval:
      return "removal";
    case EventKind::kPromotion:
      return "promotion";
    case EventKind::kDemotion:
      return "demotion";
    case EventKind::kQuiescence:
      return "quiescence";
    case EventKind::kReturn:
      return "return";
    case EventKind::kExchangeSettled:
      return "exchange_settled";
    case EventKind::kWarning:
      return "warning";
  }
  return "warning";
}

namespace {

/// What an exchange of bodies does: room and forces at once, ways when its neighbours have come to rest.
void add_exchange(const Event& event, Json& json) {
  const ExchangeEffect& effect = *event.exchange;
  json["became"] = effect.became_shell ? "shell" : "sphere";
  json["room_um3"] = number(effect.room);
  if (effect.later > 0.0) json["room_later_um3"] = number(effect.later);
  json["neighbours"] = effect.neighbours;
  if (event.kind == EventKind::kExchangeSettled) {
    json["largest_way_R"] = number(effect.largest_way), json["mean_way_R"] = number(effect.mean_way);
  } else {
    json["cell_volume_um3"] = number(effect.volume);
    if (effect.neighbours > 0) json["own_way_R"] = number(effect.own_way);  // nobody is looked at before the first step
    json["largest_force_nN"] = number(effect.largest_force), json["mean_force_nN"] = number(effect.mean_force);
  }
}

std::optional<ExchangeEffect> exchange_in(const Json& json) {
  if (!json.contains("room_um3")) return std::nullopt;
  ExchangeEffect out;
  out.neighbours = number_at(json, "neighbours", std::uint32_t{0});
  out.became_shell = text_at(json, "became") == "shell";
  out.room = number_at(json, "room_um3", 0.0), out.later = number_at(json, "room_later_um3", 0.0);
  out.volume = number_at(json, "cell_volume_um3", 0.0), out.own_way = number_at(json, "own_way_R", 0.0);
  out.largest_force = number_at(json, "largest_force_nN", 0.0), out.mean_force = number_at(json, "mean_force_nN", 0.0);
  out.largest_way = number_at(json, "largest_way_R", 0.0), out.mean_way = number_at(json, "mean_way_R", 0.0);
  return out;
}

}  // namespace

ToldEvent told(const Event& event, const Model& model) {
  ToldEvent out{event, text_of(event.reason, model), {}};
  if (event.kind != EventKind::kDivision) return out;
  for (std::size_t which = 0; which < 2; ++which) out.birth_types[which] = model.types[event.birth_type[which]].name;
  return out;
}

std::string to_json_line(const ToldEvent& told) {
  const Event& event = told.event;
  Json json{{"time_s", number(event.time)}, {"kind", name_of(event.kind)}};
  if (event.cell.valid()) json["cell"] = event.cell.text();
  if (event.first_daughter.valid() || event.second_daughter.valid())
    json["daughters"] = {event.first_daughter.text(), event.second_daughter.text()};
  if (event.volume > 0.0) {
    json["volume_um3"] = number(event.volume);
    json["birth_volumes_um3"] = {number(event.birth_volume[0]), number(event.birth_volume[1])};
  }
  if (!told.birth_types[0].empty()) json["birth_types"] = {told.birth_types[0], told.birth_types[1]};
  if (event.energy_rise) json["energy_rise_nN_um"] = number(*event.energy_rise);
  if (event.exchange) add_exchange(event, json);
  json["text"] = told.text;
  return text_of(json, -1);
}

std::optional<EventLine> event_of_line(const std::string& line) {
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const auto text = [&](const char* name) { return json.contains(name) && json[name].is_string() ? json[name].get<std::string>() : ""; };
  const auto time = json.find("time_s"), daughters = json.find("daughters");
  if (time == json.end() || !time->is_number() || text("kind").empty()) return std::nullopt;
  EventLine out;
  out.time = time->get<double>(), out.kind = text("kind"), out.cell = text("cell"), out.text = text("text");
  if (daughters != json.end())
    for (const Json& id : *daughters)
      if (id.is_string()) out.daughters.push_back(id.get<std::string>());
  if (const auto volume = json.find("volume_um3"); volume != json.end() && volume->is_number()) out.volume = volume->get<double>();
  if (const auto volumes = json.find("birth_volumes_um3"); volumes != json.end())
    for (const Json& volume : *volumes)
      if (volume.is_number()) out.birth_volumes.push_back(volume.get<double>());
  if (const auto types = json.find("birth_types"); types != json.end())
    for (const Json& type : *types)
      if (type.is_string()) out.birth_types.push_back(type.get<std::string>());
  if (const auto rise = json.find("energy_rise_nN_um"); rise != json.end() && rise->is_number()) out.energy_rise = rise->get<double>();
  out.exchange = exchange_in(json);
  return out;
}

std::vector<EventLine> events_of_lines(const std::string& lines) {
  std::vector<EventLine> out;
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);)
    if (auto event = event_of_line(line)) out.push_back(std::move(*event));
  return out;
}

std::string value_text(const Verdict& verdict) {
  return std::isnan(verdict.value) ? "nothing to judge" : number_text("%.4g", verdict.value);
}

bool Judgement::passed() const {
  return std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.passed; });
}

std::string Judgement::failures() const {
  std::vector<std::string> ids;
  for (const Verdict& v : verdicts)
    if (!v.passed && std::find(ids.begin(), ids.end(), v.id) == ids.end()) ids.push_back(v.id);
  return ids.empty() ? "" : "checks failed: " + joined(ids);
}

std::string to_json(const Judgement& judgement) {
  Json criteria = Json::array(), not_checked = Json::array();
  for (const Verdict& v : judgement.verdicts)
    criteria.push_back({{"id", v.id}, {"quantity", v.quantity}, {"value", number(v.value)}, {"limit", v.limit}, {"passed", v.passed}});
  for (const NotChecked& n : judgement.not_checked) not_checked.push_back({{"id", n.id}, {"what", n.what}, {"why", n.why}});
  return text_of(Json{{"passed", judgement.passed()}, {"criteria", criteria}, {"not_checked", not_checked}}, 2);
}

}  // namespace morula::scenarios
