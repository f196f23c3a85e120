#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/verbs.h"
#include "app/words.h"
#include "core/numbers/number_text.h"
#include "scenarios/compare/comparison_page.h"
#include "scenarios/run/progress.h"

namespace morula::app {
namespace fs = std::filesystem;
namespace {

using scenarios::ColumnDifference;
using scenarios::CompareRequest;
using scenarios::Comparison;
using scenarios::ComparisonVerdict;
using scenarios::RunGroup;
using Json = nlohmann::ordered_json;

std::string table_of(const std::vector<RunGroup>& groups, const Comparison& comparison, const CompareRequest& request) {
  std::vector<std::vector<std::string>> rows{
      {"measure", "unit", "group", groups[0].name, "group's", "difference", "95 % ±", "at", "verdict"}};
  for (const scenarios::ComparedColumn& column : comparison.columns)
    for (const ColumnDifference& d : column.differences) {
      rows.push_back({column.name, column.unit, d.group, scenarios::value_words(d.reference), scenarios::value_words(d.value),
                      scenarios::relative_words(d), std::isnan(d.interval) ? "" : number_text("%.3g", d.interval),
                      scenarios::time_text(d.time), scenarios::verdict_words(d, request)});
    }
  return table_text(rows);
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string json_of(const std::vector<RunGroup>& groups, const Comparison& comparison, const std::string& page) {
  Json out;
  for (const RunGroup& group : groups) {
    Json runs = Json::array();
    for (const scenarios::ComparedRun& run : group.runs)
      runs.push_back({{"run", run.path.string()}, {"seed", run.record.seed}, {"wall_time", run.record.wall_time}});
    out["groups"].push_back({{"name", group.name}, {"runs", runs}});
  }
  out["until"] = comparison.times.back();
  out["columns"] = Json::array();
  for (const scenarios::ComparedColumn& column : comparison.columns)
    for (const ColumnDifference& d : column.differences) {
      out["columns"].push_back({{"name", column.name},
                                {"unit", column.unit},
                                {"group", d.group},
                                {"time", d.time},
                                {"reference", {{"mean", number(d.reference.mean)}, {"spread", number(d.reference.spread)}}},
                                {"value", {{"mean", number(d.value.mean)}, {"spread", number(d.value.spread)}}},
                                {"difference", number(d.difference)},
                                {"relative", number(d.relative)},
                                {"interval", number(d.interval)},
                                {"verdict", scenarios::name_of(d.verdict)}});
    }
  out["settings"] = Json::array();
  for (const std::string& path : comparison.settings) {
    Json values;
    for (const RunGroup& group : groups) values[group.name] = scenarios::setting(group.runs[0].settings, path);
    out["settings"].push_back({{"key", path}, {"values", values}});
  }
  out["notes"] = comparison.notes;
  if (!page.empty()) out["page"] = page;
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// comparisons/A_B_C, or A_B_C-2, -3, ... where that is there already; a name may hold what is no name of a folder.
fs::path usual_folder(const std::vector<RunGroup>& groups) {
  std::string name;
  for (const RunGroup& group : groups) name += (name.empty() ? "" : "_") + group.name;
  std::ranges::replace_if(
      name, [](char c) { return c == '/' || c == '\\' || c == ' '; }, '-');
  const fs::path all = "comparisons";
  fs::path folder = all / name;
  std::error_code error;
  for (int number = 2; fs::exists(folder, error); ++number) folder = all / (name + "-" + std::to_string(number));
  return folder;
}

}  // namespace

Status compare(const CompareOptions& options, const Context& context) {
  CompareRequest request;
  request.only = options.only;
  request.every = options.every;
  if (!options.within.empty()) {
    MORULA_TRY_ASSIGN(request.within, read_part("--within", options.within));
  }
  if (!options.from.empty()) {
    MORULA_TRY_ASSIGN(request.from, read_time("--from", options.from));
  }
  if (!options.out.empty()) MORULA_TRY(must_be_new(options.out));
  MORULA_TRY_ASSIGN(const std::vector<RunGroup> groups, scenarios::read_groups(options.runs));
  MORULA_TRY_ASSIGN(const Comparison comparison, scenarios::compare(groups, request));
  fs::path page;
  if (!options.json || !options.out.empty()) {
    const fs::path folder = options.out.empty() ? usual_folder(groups) : fs::path(options.out);
    MORULA_TRY_ASSIGN(page, scenarios::write_comparison(groups, comparison, request, folder, context.laws));
  }
  for (const std::string& note : comparison.notes) context.console.note(note);
  if (!comparison.left_out.empty() && options.only.empty())
    context.console.note(count_words(comparison.left_out.size(), "column", "columns") +
                         " of the solver, of the cells' bodies, or that not all runs have, left out; --only names what is compared");
  context.console.result(options.json ? json_of(groups, comparison, page.string())
                                      : table_of(groups, comparison, request) + page.string() + "\n");
  if (!request.within) return {};
  std::size_t failed = 0, all = 0;
  for (const scenarios::ComparedColumn& column : comparison.columns)
    for (const ColumnDifference& d : column.differences) ++all, failed += d.verdict != ComparisonVerdict::kWithin;
  if (failed == 0) return {};
  return Error{
      ErrorKind::kVerification,
      count_words(failed, "difference", "differences") + " of " + std::to_string(all) + " not shown to be within " + options.within,
      "more seeds decide what is undecided"};
}

}  // namespace morula::app
