#include "scenarios/compare/comparison_page.h"

#include <algorithm>
#include <cmath>

#include "core/numbers/number_text.h"
#include "core/numbers/sample.h"
#include "report/pictures/curves.h"
#include "report/report.h"
#include "report/run_plots.h"
#include "results/file_io.h"
#include "results/run_files.h"
#include "scenarios/run/interface_table.h"
#include "scenarios/run/progress.h"
#include "scenarios/run/report_run.h"

namespace morula::scenarios {
namespace fs = std::filesystem;
namespace {

/// Wall time of a group's runs, in the mean [s].
double wall_time(const RunGroup& group) {
  double sum = 0.0;
  for (const ComparedRun& run : group.runs) sum += run.record.wall_time;
  return sum / static_cast<double>(group.runs.size());
}

ReportTable table_of_runs(const std::vector<RunGroup>& groups) {
  ReportTable out{"Runs",
                  "The first group is what the others are compared with.",
                  {"group", "run", "seed", "state", "cells", "shells", "wall time", "of the first group's"},
                  {}};
  for (const RunGroup& group : groups)
    for (const ComparedRun& run : group.runs) {
      const auto last = [&](const char* column) {
        const SeriesColumn* found = run.series.find(column);
        return found != nullptr ? number_text("%.0f", found->values.back()) : std::string();
      };
      const double first = wall_time(groups[0]);
      out.rows.push_back({group.name, run.path.string(), std::to_string(run.record.seed), name_of(run.record.state), last("cell_count"),
                          last("shell_count"), duration_text(run.record.wall_time),
                          first > 0.0 ? number_text("%.2g", run.record.wall_time / first) : ""});
    }
  return out;
}

ReportTable table_of_differences(const std::vector<RunGroup>& groups, const Comparison& comparison, const CompareRequest& request) {
  ReportTable out{"Differences",
                  "Mean ± standard deviation over the runs of a group. The interval holds the difference of the means with 95 % (Welch); "
                  "where one group has a "
                  "single run it is taken to spread as the other does.",
                  {"measure", "group", groups[0].name, "group's value", "difference", "95 % interval", "at", "verdict"},
                  {}};
  for (const ComparedColumn& column : comparison.columns)
    for (const ColumnDifference& d : column.differences) {
      out.rows.push_back({column.name + (column.unit.empty() || column.unit == "1" ? "" : " [" + column.unit + "]"), d.group,
                          value_words(d.reference), value_words(d.value), relative_words(d),
                          std::isnan(d.interval) ? "" : "± " + number_text("%.3g", d.interval), time_text(d.time),
                          verdict_words(d, request)});
    }
  return out;
}

ReportTable table_of_settings(const std::vector<RunGroup>& groups, const Comparison& comparison) {
  ReportTable out{"Settings that differ", comparison.settings.empty() ? "None: these are runs of one study." : "", {"key"}, {}};
  for (const RunGroup& group : groups) out.header.push_back(group.name);
  for (const std::string& path : comparison.settings) {
    std::vector<std::string> row{path};
    for (const RunGroup& group : groups) {
      const std::string text = setting(group.runs[0].settings, path);
      row.push_back(text.empty() ? "–" : text);
    }
    out.rows.push_back(std::move(row));
  }
  return out;
}

/// Each run a curve, each group a colour.
CurvePlot plot_of(const std::vector<RunGroup>& groups, const ComparedColumn& column, double last) {
  const auto [axis, unit] = time_axis(last);
  CurvePlot plot;
  plot.title = column.name;
  plot.x = axis;
  plot.y = {column.name, column.unit == "1" ? "" : column.unit, false, {}, {}};
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const ComparedRun& run : groups[g].runs) {
      Curve curve{groups[g].name, run.series.find("time")->values, run.series.find(column.name)->values, CurveStyle::kLine,
                  static_cast<int>(g)};
      for (double& t : curve.x) t /= unit;
      plot.curves.push_back(std::move(curve));
    }
  return plot;
}

/// What the cells of a group's first run are like at the end: bodies and pressure in a cut, and layers on both sides of where bodies meet.
Status add_cells(const RunGroup& group, const std::shared_ptr<const Laws>& laws, ReportContent& content) {
  const fs::path& path = group.runs[0].path;
  MORULA_TRY_ASSIGN(const Study study, read_run_study(path, laws));
  std::vector<std::pair<double, std::string>> damaged;
  MORULA_TRY_ASSIGN(std::vector<Snapshot> snapshots, snapshots_over_time(RunFiles(path).results(), damaged));
  if (auto table = interface_table(study, snapshots)) {
    table->title += ": " + group.name;
    content.tables.push_back(std::move(*table));
  }
  if (snapshots.size() > 1) snapshots.erase(snapshots.begin(), snapshots.end() - 1);
  for (Picture& picture : standard_pictures(snapshots, type_colors(study))) {
    if (picture.frame || !(picture.name.starts_with("cut_body") || picture.name.starts_with("cut_pressure"))) continue;
    picture.caption = group.name + ": " + picture.caption;
    MORULA_TRY_ASSIGN(EncodedPicture of_group, encoded(picture));
    content.pictures.push_back(std::move(of_group));
  }
  return {};
}

}  // namespace

std::string value_words(const GroupValue& value) {
  const double spread = told_spread(value.spread, value.mean);
  return number_text("%.4g", value.mean) + (std::isnan(spread) ? "" : " ± " + number_text("%.2g", spread));
}

std::string relative_words(const ColumnDifference& d) {
  return std::isnan(d.relative) ? number_text("%+.3g", d.difference) : number_text("%+.2f %%", 100.0 * d.relative);
}

std::string verdict_words(const ColumnDifference& d, const CompareRequest& request) {
  const std::string within = request.within ? number_text("%.3g %%", 100.0 * *request.within) : "";
  switch (d.verdict) {
    case ComparisonVerdict::kWithin:
      return "within " + within;
    case ComparisonVerdict::kBeyond:
      return "beyond " + within;
    case ComparisonVerdict::kUndecided:
      return "undecided: seeds spread by more";
    case ComparisonVerdict::kSame:
      return d.difference == 0.0 ? "the same" : "no more than seeds spread";
    case ComparisonVerdict::kDiffers:
      return std::isnan(d.in_spreads) ? "differs" : number_text("differs (%.2g standard errors)", std::abs(d.in_spreads));
    case ComparisonVerdict::kUnknown:
      return "spread not known";
  }
  return "";
}

Result<fs::path> write_comparison(const std::vector<RunGroup>& groups, const Comparison& comparison, const CompareRequest& request,
                                  const fs::path& folder, std::shared_ptr<const Laws> laws) {
  MORULA_TRY(make_folder(folder / "plots"));
  ReportContent content;
  for (const RunGroup& group : groups) content.title += (content.title.empty() ? "" : " against ") + group.name;
  content.study = groups[0].runs[0].record.study;
  content.summary = "Compared up to " + time_text(comparison.times.back()) + ", at " + std::to_string(comparison.times.size()) +
                    " outputs that all runs have.";
  if (request.within)
    for (const ComparedColumn& column : comparison.columns)
      for (const ColumnDifference& d : column.differences) {
        content.criteria.push_back({column.name, d.group + " against " + groups[0].name, relative_words(d), verdict_words(d, request),
                                    d.verdict == ComparisonVerdict::kWithin});
      }
  content.tables = {table_of_differences(groups, comparison, request), table_of_runs(groups), table_of_settings(groups, comparison)};
  ReportTable notes{"Notes", "", {}, {}};
  for (const std::string& note : comparison.notes) notes.rows.push_back({note});
  for (const RunGroup& group : groups)
    if (const Status shown = add_cells(group, laws, content); !shown.ok())
      notes.rows.push_back({"no pictures and layers of " + group.runs[0].path.string() + ": " + shown.error().message});
  if (!notes.rows.empty()) content.tables.push_back(std::move(notes));
  for (const ComparedColumn& column : comparison.columns) {
    const CurvePlot plot = plot_of(groups, column, comparison.times.back());
    MORULA_TRY(write_curves(plot, folder / "plots" / column.name));
    content.plots.push_back({"", curves_svg(plot, SvgUse::kInline), false});
  }
  const fs::path page = folder / "compare.html";
  MORULA_TRY(write_report(content, page));
  return page;
}

}  // namespace morula::scenarios
