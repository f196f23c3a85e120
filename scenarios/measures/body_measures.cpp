// Spheres and shells in one tissue: how far what they bear differs.
#include <algorithm>
#include <cmath>
#include <span>

#include "scenarios/measures/interface_layers.h"
#include "scenarios/measures/measures.h"

namespace morula::scenarios {
namespace {

using Cell = Snapshot::Cell;

Measure of_run(const char* name, const char* title, const char* doc, const char* formula, OfSnapshot value) {
  Measure out{name, title, doc, formula, "physics/fields_and_coupling.md D", Quantity::kFraction, MeasureOf::kRun};
  out.take = by_snapshot(std::move(value));
  return out;
}

/// Mean pressure of some cells; nothing of none.
template <class Choose>
std::optional<double> mean_pressure(std::span<const Cell> cells, const Choose& choose) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Cell& cell : cells)
    if (choose(cell)) sum += cell.pressure, ++count;
  return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

std::optional<double> pressure_jump(const Study&, const Snapshot& snapshot, const Subject&) {
  const auto of = [&](BodyKind body) { return mean_pressure(snapshot.cells, [body](const Cell& cell) { return cell.body == body; }); };
  const auto shells = of(BodyKind::kShell), spheres = of(BodyKind::kSphere);
  if (!shells || !spheres || *shells + *spheres <= 0.0) return std::nullopt;
  return (*shells - *spheres) / (0.5 * (*shells + *spheres));
}

/// The cells in layers along x: a layer ends where the next centre is further away than a quarter of a radius.
std::vector<std::span<const Cell>> layers_along_x(std::vector<Cell>& cells) {
  std::ranges::sort(cells, {}, [](const Cell& cell) { return cell.centroid.x; });
  std::vector<std::span<const Cell>> out;
  for (std::size_t first = 0, i = 1; i <= cells.size(); ++i)
    if (i == cells.size() || cells[i].centroid.x - cells[i - 1].centroid.x > 0.25 * cells[i].radius)
      out.push_back(std::span(cells).subspan(first, i - first)), first = i;
  return out;
}

std::optional<double> layer_spread(const Study&, const Snapshot& snapshot, const Subject&) {
  std::vector<Cell> cells = snapshot.cells;
  const auto all = [](const Cell&) { return true; };
  const auto layers = layers_along_x(cells);
  const auto mean = mean_pressure(cells, all);
  if (layers.size() < 2 || !mean || *mean <= 0.0) return std::nullopt;
  double most = 0.0;
  for (const auto& layer : layers) most = std::max(most, std::abs(*mean_pressure(layer, all) / *mean - 1.0));
  return most;
}

/// Of the cells that touch the other body.
Measure interface_jump() {
  Measure out{"interface.pressure_jump",
              "pressure of shells that touch spheres less that of spheres that touch shells",
              "Mean pressure of the shells that touch spheres less that of the spheres that touch shells; nothing where they do not meet.",
              "mean(p of shells at the interface) - mean(p of spheres at the interface)",
              "physics/fields_and_coupling.md D",
              Quantity::kPressure,
              MeasureOf::kRun};
  out.take = by_snapshot([](const Study& study, const Snapshot& snapshot, const Subject&) -> std::optional<double> {
    const LayerMean found = jump(interface_layers(snapshot, snapshot, snapshot, study.model.space), &InterfaceLayer::pressure);
    return std::isnan(found.mean) ? std::nullopt : std::optional(found.mean);
  });
  return out;
}

}  // namespace

std::vector<Measure> body_measures() {
  return {
      interface_jump(),
      of_run("bodies.pressure_jump", "pressure of shells less that of spheres, relative",
             "Mean pressure of the shells less that of the spheres, over the mean of both.", "2 (p_shell - p_sphere)/(p_shell + p_sphere)",
             &pressure_jump),
      of_run("bodies.layer_spread", "pressure of a layer against that of all cells, relative",
             "Largest difference of the mean pressure of a layer of cells from that of all cells, relative. Layers lie across x; a new one "
             "begins where the next centre is more than a quarter of a radius further along.",
             "max |p_layer/p - 1|", &layer_spread)};
}

}  // namespace morula::scenarios
