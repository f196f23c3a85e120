#include "scenarios/calibrate/knots.h"

#include <algorithm>
#include <cmath>

namespace morula::calibrate {
namespace {

constexpr double kToe = 0.01;                     // of the last missing pressure: less is no onset, but the noise of packings without order
constexpr double kAtOnset = 2.0, kWithToe = 1.5;  // power with which distances from the onset grow
constexpr double kBand = 0.03;                    // of the range of φ, that points are averaged over

/// Mean of the points with φ between these, both included.
MissingPressure mean_between(std::span<const MissingPressure> missing, double low, double high) {
  MissingPressure out;
  double count = 0.0;
  for (const MissingPressure& point : missing)
    if (point.packing >= low && point.packing <= high) out.packing += point.packing, out.pressure += point.pressure, count += 1.0;
  out.packing /= count, out.pressure /= count;
  return out;
}

/// Where the pressure sets in; 0: none is missing at the end.
double onset_of(std::span<const MissingPressure> missing) {
  const double least = std::max(0.0, kToe * missing.back().pressure);
  std::size_t first = missing.size();  // the first point from which on pressure is missing
  while (first > 0 && missing[first - 1].pressure > least) --first;
  if (missing.size() - first < 2) return 0.0;
  const double width = kBand * (missing.back().packing - missing[first].packing);
  const MissingPressure near = mean_between(missing, missing[first].packing, missing[first].packing + width);
  std::size_t next = first;
  while (next + 1 < missing.size() && missing[next].packing <= missing[first].packing + width) ++next;
  const MissingPressure far = mean_between(missing, missing[next].packing, missing[next].packing + width);
  const double rise = far.packing > near.packing ? (far.pressure - near.pressure) / (far.packing - near.packing) : 0.0;
  const double lowest = first > 0 ? std::max(missing[first - 1].packing, 1e-6) : 0.25 * missing[first].packing;
  return rise > 0.0 ? std::max(lowest, near.packing - near.pressure / rise) : lowest;
}

}  // namespace

std::vector<MissingPressure> missing_pressure(const Data& data, const PairModel& pair) {
  std::vector<MissingPressure> out;
  const auto add = [&](const PackingGeometry& at, double pressure, double radius) {
    if (at.press > 0.0) out.push_back({at.packing, (pressure - pair_pressure(at, radius, pair)) / at.press});
  };
  for (const PackingPoint& point : data.packings)
    if (!point.held_out) add(point.geometry(), point.pressure, point.radius);
  for (const ClusterPoint& point : data.clusters)
    if (!point.held_out) add(point.places, 0.0, point.radius);
  std::stable_sort(out.begin(), out.end(), [](const MissingPressure& a, const MissingPressure& b) { return a.packing < b.packing; });
  return out;
}

std::vector<double> place_knots(std::span<const MissingPressure> missing, int count, double onset) {
  if (missing.size() < 3 || count < 3) return {};
  const double grows = onset > 0.0 ? kWithToe : kAtOnset;
  if (onset == 0.0) onset = onset_of(missing);
  const double last = missing.back().packing;
  if (!(onset > 0.0) || !(onset < last) || !(missing.back().pressure > 0.0)) return {};
  std::vector<double> out;
  for (int k = 0; k < count; ++k) {
    const double part = static_cast<double>(k) / (count - 1);
    out.push_back(onset + (last - onset) * std::pow(part, grows));
  }
  return out;
}

std::vector<cbm::PackingKnot> first_curve(std::span<const MissingPressure> missing, std::span<const double> packing) {
  std::vector<cbm::PackingKnot> out;
  for (const double at : packing) {
    double pressure = missing.back().pressure;
    for (std::size_t k = 0; k < missing.size(); ++k) {
      if (missing[k].packing < at) continue;
      if (k == 0 || missing[k].packing == missing[k - 1].packing) {
        pressure = missing[k].pressure;
      } else {
        const double part = (at - missing[k - 1].packing) / (missing[k].packing - missing[k - 1].packing);
        pressure = missing[k - 1].pressure + part * (missing[k].pressure - missing[k - 1].pressure);
      }
      break;
    }
    // A thousandth of a kPa more than the last knot at least: the search looks for logarithms of increments.
    out.push_back({at, out.empty() ? 0.0 : std::max(pressure, out.back().pressure + 1e-3)});
  }
  return out;
}

}  // namespace morula::calibrate
