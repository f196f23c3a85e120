// A cell of cortical tension alone between two plates, against the drop that does not wet them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "results/series_reader.h"
#include "scenarios/library/shape_measures.h"
#include "scenarios/library/single_cell.h"
#include "scenarios/library/theory.h"
#include "scenarios/library/verdicts.h"

namespace morula::scenarios {
namespace {

struct Pressing {
  double height = 0.0;   ///< of the cell over R0
  double force = 0.0;    ///< on the moving plate over γ R0
  double balance = 0.0;  ///< sum of the forces on both plates, over the larger of one and γ R0
  double tension = 0.0;  ///< from force, pressure and equator, over γ
  theory::PressedDrop expected;
  std::uint32_t nodes = 0;
};

/// Value of a column at a time, or not a number.
double at_time(const SeriesTable& series, const std::string& column, double time) {
  const SeriesColumn* times = series.find("time");
  const SeriesColumn* values = series.find(column);
  if (!times || !values) return std::nan("");
  for (std::size_t i = 0; i < times->values.size(); ++i)
    if (std::abs(times->values[i] - time) < 1e-6 * std::max(1.0, time)) return values->values[i];
  return std::nan("");
}

Result<std::vector<Pressing>> pressings(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto snapshots, all_snapshots(run));
  MORULA_TRY_ASSIGN(const SeriesTable series, read_series(run / "series.csv"));
  const Model& model = study.model;
  std::vector<Pressing> out;
  const auto moving =
      std::find_if(model.obstacles.begin(), model.obstacles.end(), [](const ObstacleSpec& o) { return !o.distance.empty(); });
  if (moving == model.obstacles.end() || model.obstacles.size() != 2) return out;
  const ObstacleSpec& other = model.obstacles[moving == model.obstacles.begin() ? 1 : 0];
  for (const Hold& hold : holds_of(moving->distance, snapshots)) {
    for (const ShellView& shell : shells_of(snapshots[hold.snapshot], 0)) {
      const CellType& type = model.types[0];
      const double force = at_time(series, "force_z_" + moving->name, hold.time),
                   opposite = at_time(series, "force_z_" + other.name, hold.time);
      if (!(std::abs(force) > 1e-6)) continue;  // not yet touched, or no such column
      const double r0 = radius_of_volume(shell.cell->volume), gamma = type.shell.tension;
      Pressing p;
      p.height = extent(shell.nodes, {0, 0, 1}) / r0;
      p.force = std::abs(force) / (gamma * r0);
      p.balance = std::abs(force + opposite) / std::max(std::abs(force), gamma * r0);
      p.expected = theory::pressed_drop(p.height);
      p.nodes = type.shell_nodes;
      const double b = 0.25 * (extent(shell.nodes, {1, 0, 0}) + extent(shell.nodes, {0, 1, 0}));
      const double pressure = shell.cell->inner_pressure, contact = std::abs(force) / (std::numbers::pi * pressure);  // a²
      p.tension = pressure * (b * b - contact) / (2.0 * b) / gamma;
      out.push_back(p);
    }
  }
  return out;
}

}  // namespace

Result<std::vector<Verdict>> judge_parallel_plates(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto all, pressings(study, run));
  std::vector<Verdict> out;
  Largest force, tension, balance;
  double limit = 0.05, flattest = kNothing;
  for (const Pressing& p : all) {
    balance.add(p.balance);
    flattest = std::fmin(flattest, p.height);
    limit = tolerance(p.nodes, 0.06, 0.03);
    tension.add(std::abs(p.tension - 1.0));
    force.add(std::abs(p.force - p.expected.force) / std::max(1.0, p.expected.force));
  }
  out.push_back(at_least("PLATES.0", "states at rest between the plates", static_cast<double>(all.size()), 3.0));
  out.push_back(
      at_most("PLATES.1", "force on the plate against the pressed drop, over the larger of it and tension times R0", force.value(), limit));
  out.push_back(at_most("PLATES.2", "tension found from force, pressure and equator, relative error", tension.value(), limit));
  out.push_back(
      at_most("PLATES.3", "sum of the forces on both plates, over the larger of one and tension times R0", balance.value(), 0.01));
  out.push_back(at_most("PLATES.4", "height of the flattest state over R0", flattest, 1.3));
  return out;
}

Result<std::vector<NamedPlot>> plot_parallel_plates(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto all, pressings(study, run));
  CurvePlot plot;
  plot.title = "A cell between two plates: force against height";
  plot.x = {"height/R0", "", false, {}, 2.0};
  plot.y = {"force/(tension R0)", "", false, 0.0, {}};
  Curve line{"pressed drop", {}, {}, CurveStyle::kLine}, points{"cell", {}, {}, CurveStyle::kPoints};
  double low = 2.0;
  for (const Pressing& p : all) {
    low = std::min(low, p.height);
    points.x.push_back(p.height);
    points.y.push_back(p.force);
  }
  for (int i = 0; i <= 60; ++i) {
    const double height = 2.0 - (2.0 - std::max(0.3, low - 0.05)) * i / 60.0;
    line.x.push_back(height);
    line.y.push_back(theory::pressed_drop(height).force);
  }
  plot.curves = {std::move(line), std::move(points)};
  return std::vector<NamedPlot>{{"force_height", std::move(plot)}};
}

}  // namespace morula::scenarios
