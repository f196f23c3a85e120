#include "scenarios/calibrate/knots.h"

#include <algorithm>

namespace morula::calibrate {
namespace {

constexpr double kToe = 0.01;   // of the last missing pressure: less is no onset, but the noise of packings without order
constexpr double kBand = 0.03;  // of the range of φ, that points are averaged over

/// Mean of the points with φ between these, both included.
MissingPressure mean_between(std::span<const MissingPressure> missing, double low, double high) {
  MissingPressure out;
  double count = 0.0;
  for (const MissingPressure& point : missing)
    if (point.packing >= low && point.packing <= high) out.packing += point.packing, out.pressure += point.pressure, count += 1.0;
  out.packing /= count, out.pressure /= count;
  return out;
}

}  // namespace

std::vector<MissingPressure> missing_pressure(std::span<const PackingPoint> packings, const PairModel& pair) {
  std::vector<MissingPressure> out;
  for (const PackingPoint& point : packings) {
    if (point.held_out) continue;
    const PackingGeometry at = point.geometry();
    if (at.press > 0.0) out.push_back({at.packing, (point.pressure - pair_pressure(at, point.radius, pair)) / at.press});
  }
  std::stable_sort(out.begin(), out.end(), [](const MissingPressure& a, const MissingPressure& b) { return a.packing < b.packing; });
  return out;
}

std::vector<double> place_knots(std::span<const MissingPressure> missing, int count) {
  const double least = missing.empty() ? 0.0 : std::max(0.0, kToe * missing.back().pressure);
  std::size_t first = missing.size();  // the first point from which on pressure is missing
  while (first > 0 && missing[first - 1].pressure > least) --first;
  if (missing.size() < 3 || missing.size() - first < 2 || count < 3) return {};
  const double last = missing.back().packing, width = kBand * (last - missing[first].packing);
  const MissingPressure near = mean_between(missing, missing[first].packing, missing[first].packing + width);
  std::size_t next = first;
  while (next + 1 < missing.size() && missing[next].packing <= missing[first].packing + width) ++next;
  const MissingPressure far = mean_between(missing, missing[next].packing, missing[next].packing + width);
  const double rise = far.packing > near.packing ? (far.pressure - near.pressure) / (far.packing - near.packing) : 0.0;
  const double lowest = first > 0 ? std::max(missing[first - 1].packing, 1e-6) : 0.25 * missing[first].packing;
  const double onset = rise > 0.0 ? std::max(lowest, near.packing - near.pressure / rise) : lowest;
  if (!(onset < last)) return {};
  std::vector<double> out;
  for (int k = 0; k < count; ++k) {
    const double part = static_cast<double>(k) / (count - 1);
    out.push_back(onset + (last - onset) * part * part);
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
