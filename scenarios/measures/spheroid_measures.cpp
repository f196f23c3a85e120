// Compact clusters of cells: how well they fill their ball, and how their cells differ from the middle to the rim.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenarios/measures/measures.h"

namespace morula::scenarios {
namespace {

constexpr const char* kSource = "physics/scenarios.md S7";

/// Mean over the half of the cells that lies farthest from the middle less that over the quarter that lies nearest; nothing of fewer than 16 cells.
std::optional<double> outer_less_inner(std::vector<std::pair<double, double>> by_distance) {
  const std::size_t count = by_distance.size();
  if (count < 16) return std::nullopt;
  std::ranges::sort(by_distance);
  const auto mean = [&](std::size_t first, std::size_t last) {
    double sum = 0.0;
    for (std::size_t i = first; i < last; ++i) sum += by_distance[i].second;
    return sum / static_cast<double>(last - first);
  };
  return mean(count - count / 2, count) - mean(0, count / 4);
}

/// The values of the cells by their distance from the middle of all cells' volume.
template <class Value>
std::vector<std::pair<double, double>> by_distance(const Snapshot& snapshot, const Subject& subject, const Value& value) {
  Vec3d middle;
  double volume = 0.0;
  for (const Snapshot::Cell& cell : snapshot.cells) {
    middle += cell.centroid * cell.volume;
    volume += cell.volume;
  }
  std::vector<std::pair<double, double>> out;
  for (const Snapshot::Cell& cell : snapshot.cells)
    if (is_meant(cell, subject)) out.emplace_back(norm(cell.centroid - middle / volume), value(cell));
  return out;
}

Measure filled() {
  Measure out{"spheroid.filled",
              "volume of the cells over that of the spheroid",
              "Volume of all cells over that of the ball with the tissue's radius of gyration: the part of a spheroid that is no gap.",
              "sum V/(4/3 pi R^3)",
              kSource,
              Quantity::kFraction,
              MeasureOf::kRun};
  const std::vector<std::string> columns{"total_volume", "spheroid_radius"};
  out.columns = [columns](const Study&, const Subject&) { return columns; };
  out.take = [columns](FinishedRun& run, const Subject&, const Moments& moments) {
    return by_row(run, columns, moments, [](double, const std::vector<double>& row) {
      return row[0] / (4.0 / 3.0 * std::numbers::pi * row[1] * row[1] * row[1]);
    });
  };
  return out;
}

Measure outward(const char* name, const char* title, const char* doc, Quantity quantity, double (*value)(const Snapshot::Cell& cell)) {
  Measure out{name, title, doc, "mean(outer half) - mean(inner quarter)", kSource, quantity, MeasureOf::kCells};
  out.take = by_snapshot([value](const Study&, const Snapshot& snapshot, const Subject& subject) {
    return outer_less_inner(by_distance(snapshot, subject, value));
  });
  return out;
}

}  // namespace

std::vector<Measure> spheroid_measures() {
  return {filled(),
          outward("spheroid.sphericity_rise", "sphericity of outer cells less that of inner ones",
                  "Mean sphericity of the half of the cells that is farthest from the middle less that of the quarter that is nearest: "
                  "above 0 where inner "
                  "cells are polyhedra.",
                  Quantity::kNumber, &sphericity),
          outward("spheroid.pressure_rise", "pressure of outer cells less that of inner ones",
                  "Mean pressure of the half of the cells that is farthest from the middle less that of the quarter that is nearest.",
                  Quantity::kPressure, [](const Snapshot::Cell& cell) { return cell.pressure; })};
}

}  // namespace morula::scenarios
