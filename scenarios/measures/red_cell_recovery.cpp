// Red blood cells going back after a pull, against cells that were measured.
#include <cmath>

#include "scenarios/measures/interpolated.h"
#include "scenarios/measures/pulled_cell.h"

namespace morula::scenarios {
namespace {

constexpr int kMeasuredCells = 4;

struct Measured {
  std::vector<double> time, ratio;
};

/// Length over width of four cells (rbc_shape_recovery.csv) every 0.05 s.
constexpr double kInterval = 0.05;  // [s]
constexpr double kMeasuredRatios[kMeasuredCells][9] = {{2.00, 1.60, 1.40, 1.31, 1.24, 1.18, 1.16, 1.13, 1.11},
                                                       {2.19, 1.74, 1.52, 1.41, 1.36, 1.29, 1.25, 1.25, 1.22},
                                                       {1.94, 1.66, 1.52, 1.41, 1.34, 1.31, 1.25, 1.24, 1.22},
                                                       {2.00, 1.67, 1.52, 1.36, 1.27, 1.22, 1.16, 1.15, 1.13}};

Measured measured_recovery(int cell) {
  Measured out;
  for (const double ratio : kMeasuredRatios[cell - 1]) {
    out.time.push_back(kInterval * static_cast<double>(out.time.size()));
    out.ratio.push_back(ratio);
  }
  return out;
}

/// Length over width as it falls, from the moment on when it is `start`: time since then.
Measured falling_from(const std::vector<PulledCell>& recovery, double start) {
  Measured out;
  for (std::size_t i = 0; i + 1 < recovery.size(); ++i) {
    const double here = recovery[i].length / recovery[i].width, next = recovery[i + 1].length / recovery[i + 1].width;
    if (out.time.empty()) {
      if (!(here >= start && next < start)) continue;
      out.time.push_back(recovery[i].time + (recovery[i + 1].time - recovery[i].time) * (here - start) / (here - next));
      out.ratio.push_back(start);
    }
    out.time.push_back(recovery[i + 1].time);
    out.ratio.push_back(next);
  }
  if (!out.time.empty()) {
    const double zero = out.time.front();
    for (double& t : out.time) t -= zero;
  }
  return out;
}

/// Squares and the largest difference of one measured cell from our curve with times multiplied by `scale`. Measured points after the end of our
/// curve make the squares NaN; the difference is NaN where they are more than half.
void compare(const std::vector<PulledCell>& recovery, int cell, double scale, double& squares, double& largest) {
  const Measured data = measured_recovery(cell);
  const Measured ours = data.time.empty() ? Measured{} : falling_from(recovery, data.ratio.front());
  if (ours.time.size() < 3) {
    squares = largest = std::nan("");
    return;
  }
  std::size_t compared = 0;
  for (std::size_t i = 0; i < data.time.size(); ++i) {
    const double here = interpolated(ours.time, ours.ratio, data.time[i] / scale);
    squares += std::pow(here - data.ratio[i], 2);
    const double difference = std::abs(here - data.ratio[i]);
    if (std::isnan(difference)) continue;
    ++compared;
    if (difference > largest) largest = difference;
  }
  if (2 * compared < data.time.size()) largest = std::nan("");
}

}  // namespace

RecoveryFit fit_recovery(const std::vector<PulledCell>& recovery) {
  RecoveryFit out;
  double least = 1e300;
  for (int i = -60; i <= 60; ++i) {  // a tenth to ten times our viscosity
    const double scale = std::pow(10.0, i / 60.0);
    double squares = 0.0, unused = 0.0;
    compare(recovery, 1, scale, squares, unused);
    if (!(squares < least)) continue;
    least = squares;
    out.scale = scale;
  }
  if (out.scale == 0.0) return {std::nan(""), std::nan("")};
  double squares = 0.0;
  for (int cell = 1; cell <= kMeasuredCells; ++cell) compare(recovery, cell, out.scale, squares, out.largest);
  return out;
}

}  // namespace morula::scenarios
