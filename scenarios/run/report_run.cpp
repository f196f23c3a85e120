#include "scenarios/run/report_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <new>
#include <sstream>

#include "report/pictures/palette.h"
#include "report/pictures/png.h"
#include "report/report.h"
#include "report/run_plots.h"
#include "results/export.h"
#include "results/file_io.h"
#include "results/run_files.h"
#include "results/run_record.h"
#include "results/snapshot_file.h"
#include "scenarios/criteria/judge.h"
#include "scenarios/run/interface_table.h"
#include "scenarios/run/progress.h"
#include "scenarios/run/used_laws.h"

namespace morula::scenarios {
namespace fs = std::filesystem;
namespace {

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// The value with the unit that its limit has: "<= 0.3 um" is a sign, a number and a unit.
std::string with_unit_of_limit(const Verdict& verdict) {
  const std::size_t unit = verdict.limit.find(' ', 3);
  const bool has_unit = (verdict.limit.starts_with("<= ") || verdict.limit.starts_with(">= ")) && unit != std::string::npos;
  return value_text(verdict) + (has_unit && std::isfinite(verdict.value) ? verdict.limit.substr(unit) : "");
}

/// Adds an exchange of bodies, or what became of it, to what the report tells of its kind.
void add_exchange(const EventLine& event, std::map<std::string, ReportExchanges>& by_kind) {
  if (!event.exchange) return;
  const ExchangeEffect& effect = *event.exchange;
  if (event.kind != name_of(EventKind::kExchangeSettled)) {
    ReportExchanges& all = by_kind[event.kind];
    all.room += effect.room;
    all.largest_force = std::max(all.largest_force, effect.largest_force);
    all.largest_own_way = std::max(all.largest_own_way, effect.own_way);
    ++all.count;
    if (effect.neighbours > 0)  // none are looked at before the first step
      all.mean_force += (effect.mean_force - all.mean_force) / static_cast<double>(++all.measured);
    return;
  }
  ReportExchanges& all = by_kind[name_of(effect.became_shell ? EventKind::kPromotion : EventKind::kDemotion)];
  all.largest_way = std::max(all.largest_way, effect.largest_way);
  all.mean_way += (effect.mean_way - all.mean_way) / static_cast<double>(++all.settled);
}

/// Counts by kind and the warnings of events.jsonl; lines that are not whole are left out.
void read_events(const fs::path& path, ReportContent& content) {
  const auto text = read_file(path);
  if (!text.ok()) return;  // no events
  std::map<std::string, ReportEvents> by_kind;
  std::map<std::string, ReportExchanges> exchanges;
  for (const EventLine& event : events_of_lines(*text)) {
    if (event.kind == name_of(EventKind::kWarning)) content.warnings.emplace_back(event.time, event.text);
    add_exchange(event, exchanges);
    if (event.kind == name_of(EventKind::kExchangeSettled)) continue;  // no event of its own, but what became of one
    ReportEvents& events = by_kind[event.kind];
    if (events.count++ == 0) events.first = event.time;
    events.last = event.time;
  }
  for (auto& [kind, one] : exchanges) {
    one.kind = kind;
    content.exchanges.push_back(one);
  }
  for (auto& [kind, events] : by_kind) {
    events.kind = kind;
    std::replace(events.kind.begin(), events.kind.end(), '_', ' ');
    content.events.push_back(events);
  }
}

void add_limit(const SeriesTable& series, const char* column, const char* name, double limit, const char* unit, ReportContent& content) {
  const SeriesColumn* values = series.find(column);
  const SeriesColumn* time = series.find("time");
  if (!values || values->values.empty()) return;
  const auto worst = std::max_element(values->values.begin(), values->values.end());
  content.limits.push_back(
      {name, *worst, limit, unit, time ? time->values[static_cast<std::size_t>(worst - values->values.begin())] : -1.0});
}

bool had_spheres(const SeriesTable& series) {
  const SeriesColumn* spheres = series.find("sphere_count");
  return spheres != nullptr && std::ranges::any_of(spheres->values, [](double count) { return count > 0.0; });
}

/// Below the curves of outside_law: how much of what the spheres did is within what their laws are for. Nothing below others.
std::string caption_of(const NamedPlot& plot, const SeriesTable& series) {
  const SeriesColumn *time = series.find("time"), *part = series.find("contacts_beyond_range");
  if (plot.name != "outside_law" || time == nullptr || part == nullptr || part->values.empty()) return "";
  const auto size = [](double value) { return std::isnan(value) ? -1.0 : value; };  // no number where no spheres touch
  const auto most = static_cast<std::size_t>(std::ranges::max_element(part->values, {}, size) - part->values.begin());
  if (std::isnan(part->values[most])) return "";
  const double last = part->values.back();
  return (std::isnan(last) ? std::string("No spheres touch at the end; of the contacts of spheres")
                           : short_text(100.0 * last) + " % of the contacts of spheres are outside of the range of their law at the end,") +
         " at most " + short_text(100.0 * part->values[most]) + " % " +
         (std::isnan(last) ? "were outside of the range of their law " : "") + "(at " + time_text(time->values[most]) +
         "). Within it: overlaps that the law was fitted to, or else contact radii below 0.45 R, and packing that its curve is made for.";
}

/// Nodes of a shell, on average over the cells of the end.
double mean_nodes(const Study& study, const SeriesTable& series) {
  double cells = 0.0, nodes = 0.0;
  for (const CellType& type : study.model.types) {
    const SeriesColumn* count = series.find("count_" + type.name);
    const double here = count != nullptr && !count->values.empty() ? count->values.back() : 1.0;
    cells += here;
    nodes += here * type.shell_nodes;
  }
  return cells > 0.0 ? nodes / cells : 0.0;
}

/// Of a hybrid: what of the time its shells took, and what the run would take were all its cells shells, by the load of either body (cost_model.h). A node
/// costs more the more shells there are: 0.033, 0.045 and 0.08 s an hour and thousand nodes among 13, 55 and 1,000 shells, some N^0.2; and up to 2.5 times
/// that, measured on `hybrid_spheroid`, where nothing but the body was another.
void add_cost_by_body(const Study& study, const RunRecord& record, const SeriesTable& series, ReportContent& content) {
  const SeriesColumn *spheres = series.find("sphere_count"), *shells = series.find("shell_count");
  if (spheres == nullptr || shells == nullptr || !(record.wall_time > 0.0)) return;
  const double nodes = mean_nodes(study, series);
  Load as_it_was, all_shells;
  for (std::size_t i = 0; i < series.rows(); ++i) {
    as_it_was.spheres += spheres->values[i];
    as_it_was.nodes += shells->values[i] * nodes;
    all_shells.nodes += (spheres->values[i] + shells->values[i]) * nodes;
  }
  if (!(as_it_was.spheres > 0.0) || !(as_it_was.nodes > 0.0)) return;
  const double of_shells = Load{.nodes = as_it_was.nodes}.total() / as_it_was.total();
  content.key_numbers.push_back({"time for its shells, by their load", short_text(std::round(100.0 * of_shells)), "%"});
  const double longer = record.wall_time * all_shells.total() / as_it_was.total() * std::pow(all_shells.nodes / as_it_was.nodes, 0.2);
  content.key_numbers.push_back({"were all its cells shells, about", duration_text(WallRange{longer, 2.5 * longer}), ""});
}

void add_key_numbers(const RunRecord& record, const SeriesTable& series, ReportContent& content) {
  auto& out = content.key_numbers;
  const auto last = [&](const char* column) {
    return series.find(column) && series.rows() > 0 ? series.find(column)->values.back() : std::nan("");
  };
  const auto add = [&](const char* column, const char* name, const char* unit, double scale = 1.0) {
    if (std::isfinite(last(column))) out.push_back({name, short_text(scale * last(column)), unit});
  };
  add("cell_count", "cells", "");
  add("shell_count", "shells", "");
  const double time = last("time");
  const bool at_rest = record.final_state && record.final_state->at_rest;
  if (std::isfinite(time)) out.push_back({"simulated", time_text(time) + (at_rest ? ", then at rest" : ""), ""});
  if (record.wall_time > 0.0) {
    out.push_back({"wall time", duration_text(record.wall_time), ""});
    // a run that goes on from another one begins where that one was
    if (std::isfinite(time))
      out.push_back({"speed", time_text((time - series.find("time")->values.front()) / record.wall_time), "of tissue per second"});
  }
  add("spheroid_radius", "radius", "µm");
  add("mean_pressure", "mean pressure", "Pa", 1000.0);
  add("mean_contact_area", "contact area per cell", "µm²");
  if (had_spheres(series)) add("contacts_beyond_range", "contacts of spheres outside of the range of their law", "%", 100.0);
  if (std::isfinite(last("step_count")) && last("step_count") > 0 && std::isfinite(time))
    out.push_back({"mean step", short_text(time / last("step_count")), "s"});
}

void add_provenance(const RunRecord& r, ReportContent& content) {
  auto& out = content.provenance;
  out = {{"Morula", r.version + " (" + r.git_hash + ")"},
         {"command", r.command},
         {"seed", std::to_string(r.seed)},
         {"ranks × threads", std::to_string(r.ranks) + " × " + std::to_string(r.threads)},
         {"compiler", r.compiler},
         {"build", r.build_type},
         {"host", r.host},
         {"started", r.started},
         {"finished", r.finished},
         {"study (SHA-256)", r.study_hash}};
  for (const auto& [name, version] : r.libraries) out.emplace_back(name, version);
  if (!r.parent.empty()) out.emplace_back("goes on from", r.parent);
  if (r.final_state) out.emplace_back("state hash", r.final_state->state_hash);
}

std::string text_of(const fs::path& path) {
  auto text = read_file(path);
  return text.ok() ? std::move(text).value() : "";
}

void add_citation(const RunRecord& r, ReportContent& content) {
  content.citation = "The Morula authors. Morula: hybrid simulation of tissues made of spheres and deformable shells, version " +
                     r.version + " (" + r.git_hash + "). The laws that were used have their own sources, above.";
  content.bibtex =
      "@software{morula,\n  author  = {{The Morula authors}},\n"
      "  title   = {Morula: hybrid simulation of tissues made of spheres and deformable shells},\n"
      "  version = {" +
      r.version + "},\n  note    = {commit " + r.git_hash + "},\n  year    = {" + r.started.substr(0, 4) + "}\n}\n";
}

std::string state_text(const RunRecord& record) {
  switch (record.state) {
    case RunState::kRunning:
      return "still running";
    case RunState::kDone:
      return "done";
    case RunState::kStopped:
      return record.message;
    case RunState::kFailed:
      return "failed: " + record.message;
  }
  return "";
}

}  // namespace

Result<std::vector<Snapshot>> snapshots_over_time(const fs::path& results, std::vector<std::pair<double, std::string>>& damaged) {
  MORULA_TRY_ASSIGN(const auto entries, list_snapshots(results));
  std::vector<Snapshot> out;
  std::size_t last = entries.size();
  for (int quarter = 0; quarter <= 4 && !entries.empty(); ++quarter) {
    const double wanted = entries.front().time + 0.25 * quarter * (entries.back().time - entries.front().time);
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < entries.size(); ++i)
      if (std::abs(entries[i].time - wanted) < std::abs(entries[nearest].time - wanted)) nearest = i;
    if (nearest == last) continue;
    last = nearest;
    auto snapshot = read_snapshot(results, entries[nearest].index);
    if (snapshot.ok())
      out.push_back(std::move(snapshot).value());
    else if (snapshot.error().kind == ErrorKind::kFile)
      damaged.emplace_back(entries[nearest].time, "a snapshot is left out of the pictures: " + snapshot.error().message);
    else
      return std::move(snapshot).error();
  }
  return out;
}

TypeColors type_colors(const Study& study) {
  TypeColors out;
  for (const std::string& text : study.type_colors) out.push_back(color_of_text(text));
  return out;
}

Result<Study> read_run_study(const fs::path& run, std::shared_ptr<const Laws> laws) {
  auto study = read_study(RunFiles(run).resolved_study(), {.laws = std::move(laws), .judge_places = false});
  if (!study.ok()) return study.error().as_error();
  return std::move(study).value();
}

Result<fs::path> write_run_report(const Study& study, const RunRecord& record, const fs::path& run, const Judgement& judgement) {
  const RunFiles files(run);
  MORULA_TRY_ASSIGN(const SeriesTable series, read_series(files.series()));
  MORULA_TRY(make_folder(files.plots()));
  ReportContent content;
  content.title = study.title.empty() ? study.name : study.title;
  content.study = study.name;
  content.scenario = study.scenario;
  content.state = state_text(record);
  for (const Verdict& v : judgement.verdicts) content.criteria.push_back({v.id, v.quantity, with_unit_of_limit(v), v.limit, v.passed});
  content.not_checked = judgement.not_checked;
  MORULA_TRY_ASSIGN(const std::vector<NamedPlot> plots, plots_of(study, run, series));
  for (const NamedPlot& one : plots) {
    MORULA_TRY(write_curves(one.plot, files.plots() / one.name));
    content.plots.push_back({caption_of(one, series), curves_svg(one.plot, SvgUse::kInline), one.numerics});  // the plot has its title
  }
  MORULA_TRY_ASSIGN(const auto snapshots, snapshots_over_time(files.results(), content.warnings));
  for (const Picture& picture : standard_pictures(snapshots, type_colors(study))) {
    MORULA_TRY_ASSIGN(EncodedPicture one, encoded(picture));
    MORULA_TRY(write_png(one.png, files.plots() / (one.name + ".png")));
    content.pictures.push_back(std::move(one));
  }
  if (auto table = interface_table(study, snapshots)) content.tables.push_back(std::move(*table));
  add_key_numbers(record, series, content);
  add_cost_by_body(study, record, series, content);
  add_limit(series, "volume_error", "volume error", study.model.limits.volume_error, "", content);
  add_limit(series, "worst_overlap", "overlap", study.model.limits.overlap, "µm", content);
  add_limit(series, "field_balance", "field balance", study.model.limits.field_balance, "", content);
  read_events(files.events(), content);
  add_provenance(record, content);
  content.laws = used_laws(study);
  content.study_text = text_of(files.study());
  content.parameters_text = text_of(files.resolved_study());
  add_citation(record, content);
  MORULA_TRY(write_report(content, files.report()));
  return files.report();
}

namespace {

Result<RunOutputs> make_outputs(const Study& study, const RunRecord& record, const RunFolder& folder) {
  RunOutputs out;
  MORULA_TRY_ASSIGN(out.judgement, judge(study, folder.path()));
  MORULA_TRY(folder.write_verdict(out.judgement));
  MORULA_TRY_ASSIGN(const std::string resolved, read_file(folder.resolved_study()));
  MORULA_TRY(
      write_file_atomically(folder.methods(), methods_text(study.title.empty() ? study.name : study.title, used_laws(study), resolved)));
  if (std::find(study.output.formats.begin(), study.output.formats.end(), "vtk") != study.output.formats.end()) {
    auto exported = export_snapshots(folder.results(), folder.vtk(), ExportFormat::kVtk, {});
    if (!exported.ok()) return std::move(exported).error();
  }
  if (study.output.report) {
    MORULA_TRY_ASSIGN(out.report, write_run_report(study, record, folder.path(), out.judgement));
  }
  return out;
}

}  // namespace

Result<RunOutputs> finish_outputs(const Study& study, const RunRecord& record, const RunFolder& folder) {
  try {
    return make_outputs(study, record, folder);
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::kResources, "out of memory at the criteria, pictures and report",
                 "the results are whole: `morula resume` makes them again, where there is more memory"};
  }
}

Result<fs::path> plot_run(const fs::path& run, std::shared_ptr<const Laws> laws) {
  MORULA_TRY_ASSIGN(const RunRecord record, read_run_record(RunFiles(run).record()));
  MORULA_TRY_ASSIGN(const Study study, read_run_study(run, std::move(laws)));
  MORULA_TRY_ASSIGN(const Judgement judgement, judge(study, run));
  return write_run_report(study, record, run, judgement);
}

}  // namespace morula::scenarios
