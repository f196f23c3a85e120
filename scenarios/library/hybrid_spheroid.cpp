#include "scenarios/library/hybrid_spheroid.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "results/series_reader.h"
#include "scenarios/library/verdicts.h"

namespace morula::scenarios {
namespace {

constexpr double kWhole = 86400.0;       // the numbers of cells are those of a whole run [s]
constexpr double kHold = 1800.0;         // S7.8 [s]
constexpr double kContactPart = 0.3;     // of the surface, on average
constexpr double kLeastMeanStep = 15.0;  // 100 times the explicit limit of shells of 162 nodes, 0.15 s (time_stepping.md)

/// Shortest time for which a cell is known to have kept a body that it was given after time 0: to its next exchange, and where no cell has a second one,
/// to the end of the run for the cell that was exchanged first. kNothing when no cell was exchanged [s].
Result<double> shortest_hold(const std::filesystem::path& events, double end) {
  double shortest = std::numeric_limits<double>::infinity(), first = kNothing;
  std::ifstream file(events);
  if (!file) return Error{ErrorKind::kFile, "'" + events.string() + "' cannot be read", {}};
  std::map<std::string, double> last;
  for (std::string line; std::getline(file, line);) {
    const auto event = nlohmann::json::parse(line, nullptr, false);
    if (!event.is_object() || !event.contains("cell") || !event.contains("time_s")) continue;
    const std::string kind = event.value("kind", "");
    const double time = event.value("time_s", 0.0);
    if ((kind != "promotion" && kind != "demotion") || time == 0.0) continue;
    first = std::fmin(first, time);
    const auto [at, fresh] = last.try_emplace(event.value("cell", ""), time);
    if (!fresh) shortest = std::min(shortest, time - at->second);
    at->second = time;
  }
  return std::isfinite(shortest) ? shortest : end - first;
}

}  // namespace

Status hybrid_spheroid_needs(const Study& study) {
  return study.model.swaps.regions.empty() && study.model.swaps.triggers.empty()
             ? Status(Error{ErrorKind::kInput, "regions or triggers that exchange bodies (`coupling`)", ""})
             : Status{};
}

Result<std::vector<Verdict>> judge_hybrid_spheroid(const Study&, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const SeriesTable series, read_series(run / "series.csv"));
  const auto last = [&](const char* name) {
    const SeriesColumn* column = series.find(name);
    return column != nullptr && !column->values.empty() ? column->values.back() : kNothing;
  };
  MORULA_TRY_ASSIGN(const double hold, shortest_hold(run / "events.jsonl", last("time")));
  std::vector<Verdict> out;
  if (last("time") > 0.999 * kWhole) {
    out.push_back(within("DEMO.1", "shells at the end", last("shell_count"), 40, 60));
    out.push_back(within("DEMO.2", "cells at the end", last("cell_count"), 350, 450));
  }
  const double volume = last("total_volume") / last("cell_count");
  const double area = std::cbrt(36.0 * std::numbers::pi * volume * volume);  // of a ball of that volume
  out.push_back(at_least("DEMO.3", "mean contact area over the surface of a ball of the mean volume", last("mean_contact_area") / area,
                         kContactPart));
  out.push_back(at_least("DEMO.4", "mean step", last("time") / std::max(1.0, last("step_count")), kLeastMeanStep, "s"));
  out.push_back(at_least("S7.8", "shortest time for which a cell kept a body that it was given", hold, kHold, "s"));
  return out;
}

}  // namespace morula::scenarios
