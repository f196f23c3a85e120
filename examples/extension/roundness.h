#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include <coupling/observables/observable.h>

/// A column of series.csv: the mean sphericity of the shells, π^(1/3) (6V)^(2/3)/A, 1 for balls; the same bits on any number of ranks.
inline std::vector<morula::Observable> roundness(const morula::Model& /*model*/) {
  const auto of_cell = [](const morula::CellView& cell) {
    if (cell.row().body != morula::BodyKind::kShell) return std::nan("");  // left out of the mean
    return std::cbrt(std::numbers::pi * 36.0 * cell.volume * cell.volume) / cell.area;
  };
  return {{"mean_sphericity", "1", "Mean sphericity of the shells.",
           [of_cell](const morula::Moment& moment) { return moment.cells.mean(of_cell); }}};
}
