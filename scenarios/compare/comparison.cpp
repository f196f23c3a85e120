#include "scenarios/compare/comparison.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "core/numbers/sample.h"
#include "scenarios/run/progress.h"

namespace morula::scenarios {
namespace {

/// Columns about steps and solver.
bool is_numerics(const std::string& name) {
  static const std::set<std::string> names{"step_count",   "step_size",    "newton_iterations", "linear_iterations",  "retries",
                                           "volume_error", "overlap",      "worst_overlap",     "total_volume_error", "field_balance",
                                           "energy",       "centre_drift", "rotation",          "outside_fields"};
  return names.contains(name) || name.starts_with("balance_");
}

/// Columns about which cells have which body: runs with other bodies differ in them because they were asked to.
bool is_about_bodies(const std::string& name) {
  static const std::set<std::string> names{"sphere_count",     "shell_count",     "shell_fraction",     "shell_pressure",
                                           "inner_pressure",   "promotions",      "demotions",          "contacts_beyond_range",
                                           "mean_outside_law", "max_outside_law", "spheres_outside_law"};
  return names.contains(name);
}

/// The row of a time; none where a run has none. Steps land on outputs: a rounding of their times is no difference.
std::optional<std::size_t> row_at(const SeriesTable& series, double time) {
  const std::vector<double>& own = series.find("time")->values;
  const double rounding = 1e-9 * std::max(1.0, std::abs(time));
  const auto at = std::ranges::lower_bound(own, time - rounding);
  if (at == own.end() || *at > time + rounding) return std::nullopt;
  return static_cast<std::size_t>(at - own.begin());
}

std::vector<double> common_times(const std::vector<RunGroup>& groups, double from) {
  std::vector<double> out = groups[0].runs[0].series.find("time")->values;
  for (const RunGroup& group : groups)
    for (const ComparedRun& run : group.runs) std::erase_if(out, [&](double time) { return time < from || !row_at(run.series, time); });
  return out;
}

/// A column of each run of each group; none where a run lacks it. kInput: units differ.
using ColumnOfRuns = std::vector<std::vector<const SeriesColumn*>>;
Result<std::optional<ColumnOfRuns>> column_of(const std::vector<RunGroup>& groups, const std::string& name) {
  ColumnOfRuns out;
  const SeriesColumn* first = nullptr;
  for (const RunGroup& group : groups) {
    out.emplace_back();
    for (const ComparedRun& run : group.runs) {
      const SeriesColumn* column = run.series.find(name);
      if (column == nullptr) return std::optional<ColumnOfRuns>();
      if (first == nullptr) first = column;
      if (column->unit != first->unit)
        return Error{ErrorKind::kInput,
                     "'" + name + "' is in " + first->unit + " in " + groups[0].runs[0].path.string() + " and in " + column->unit + " in " +
                         run.path.string(),
                     "these runs were made by programs that write other units: run one of them again"};
      out.back().push_back(column);
    }
  }
  return std::optional(std::move(out));
}

/// The rows of the common times, by group and run.
using Rows = std::vector<std::vector<std::vector<std::size_t>>>;
Rows rows_of(const std::vector<RunGroup>& groups, const std::vector<double>& times) {
  Rows out;
  for (const RunGroup& group : groups) {
    out.emplace_back();
    for (const ComparedRun& run : group.runs) {
      out.back().emplace_back();
      for (const double time : times) out.back().back().push_back(*row_at(run.series, time));
    }
  }
  return out;
}

/// The values of a column at one of the common times, by run of a group.
std::vector<double> values_at(const ColumnOfRuns& columns, const Rows& rows, std::size_t group, std::size_t time) {
  std::vector<double> out;
  for (std::size_t r = 0; r < columns[group].size(); ++r) out.push_back(columns[group][r]->values[rows[group][r][time]]);
  return out;
}

/// Where the means of two groups are judged: where they are farthest apart, or at the last time; of times at which both have a value, if there are any.
std::size_t place_to_judge(const std::vector<double>& a, const std::vector<double>& b, bool every) {
  std::size_t at = a.size() - 1;
  double most = -1.0;
  for (std::size_t t = 0; t < a.size(); ++t) {
    const double apart = std::abs(a[t] - b[t]);
    if (std::isnan(apart) || (every && apart < most)) continue;
    most = apart;
    at = t;
  }
  return at;
}

ComparedColumn compared(const std::vector<RunGroup>& groups, const ColumnOfRuns& columns, const Rows& rows,
                        const std::vector<double>& times, const CompareRequest& request) {
  ComparedColumn out{columns[0][0]->name, columns[0][0]->unit, {}};
  std::vector<std::vector<double>> mean(groups.size());  // by group and time
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t t = 0; t < times.size(); ++t) mean[g].push_back(mean_of_sample(values_at(columns, rows, g, t)));
  double largest = 0.0;
  for (const double m : mean[0])
    if (!std::isnan(m)) largest = std::max(largest, std::abs(m));
  for (std::size_t g = 1; g < groups.size(); ++g) {
    const std::size_t at = place_to_judge(mean[0], mean[g], request.every);
    const double size = request.every ? largest : std::abs(mean[0][at]);
    out.differences.push_back(difference_of(values_at(columns, rows, 0, at), values_at(columns, rows, g, at), size, request.within));
    out.differences.back().group = groups[g].name;
    out.differences.back().time = times[at];
  }
  return out;
}

void tell_ends(const std::vector<RunGroup>& groups, const Comparison& comparison, std::vector<std::string>& notes) {
  const double until = comparison.times.back();
  for (const RunGroup& group : groups)
    for (const ComparedRun& run : group.runs) {
      const double end = run.series.find("time")->values.back();
      if (run.record.state != RunState::kDone)
        notes.push_back(run.path.string() + " is " + name_of(run.record.state) +
                        (run.record.message.empty() ? "" : ": " + run.record.message));
      if (end > until) notes.push_back(run.path.string() + " goes on to " + time_text(end) + "; compared is up to " + time_text(until));
    }
  for (const RunGroup& group : groups)
    if (group.runs.size() == 1) notes.push_back("'" + group.name + "' is one run: how far seeds spread is not known of it");
}

}  // namespace

Result<Comparison> compare(const std::vector<RunGroup>& groups, const CompareRequest& request) {
  Comparison out;
  out.times = common_times(groups, request.from);
  if (out.times.empty()) {
    const std::vector<double> at_all = common_times(groups, 0.0);
    if (at_all.empty())
      return Error{ErrorKind::kInput, "the runs have no output at the same time", "give their studies the same `time: {output: ...}`"};
    return Error{ErrorKind::kInput, "the last output that all runs have is at " + time_text(at_all.back()), "an earlier `--from`"};
  }
  tell_ends(groups, out, out.notes);
  std::vector<const Settings*> studies;
  for (const RunGroup& group : groups) studies.push_back(&group.runs[0].settings);
  out.settings = differing_paths(studies, kNotTheStudy);
  const Rows rows = rows_of(groups, out.times);
  std::vector<std::string> names = request.only;
  if (names.empty())
    for (const SeriesColumn& column : groups[0].runs[0].series.columns) {
      if (column.name == "time") continue;
      (is_numerics(column.name) || is_about_bodies(column.name) ? out.left_out : names).push_back(column.name);
    }
  for (const std::string& name : names) {
    MORULA_TRY_ASSIGN(const auto columns, column_of(groups, name));
    if (columns) {
      out.columns.push_back(compared(groups, *columns, rows, out.times, request));
    } else if (request.only.empty()) {
      out.left_out.push_back(name);
    } else {
      return Error{ErrorKind::kInput, "not all runs have a column '" + name + "' in series.csv", "the first line of that file names them"};
    }
  }
  if (out.columns.empty())
    return Error{ErrorKind::kInput, "the runs have no column of series.csv in common",
                 "give their studies the same `output: {series: ...}`"};
  return out;
}

}  // namespace morula::scenarios
