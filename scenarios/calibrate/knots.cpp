#include "scenarios/calibrate/knots.h"

#include <algorithm>

#include "scenarios/calibrate/lattice.h"

namespace morula::calibrate {

std::vector<MissingPressure> missing_pressure(std::span<const PackingPoint> packings, const PairModel& pair) {
  std::vector<MissingPressure> out;
  for (const PackingPoint& point : packings) {
    if (point.held_out) continue;
    const LatticeGeometry at = lattice_geometry(point.lattice, point.volume_ratio);
    if (at.press > 0.0) out.push_back({at.packing, (point.pressure - pair_pressure(at, point.radius, pair)) / at.press});
  }
  std::stable_sort(out.begin(), out.end(), [](const MissingPressure& a, const MissingPressure& b) { return a.packing < b.packing; });
  return out;
}

std::vector<double> place_knots(std::span<const MissingPressure> missing, int count) {
  std::size_t first = missing.size();  // the first point from which on pressure is missing
  while (first > 0 && missing[first - 1].pressure > 0.0) --first;
  if (missing.size() < 3 || missing.size() - first < 2 || count < 3) return {};
  std::size_t second = first + 1;  // two lattices may have the same φ
  while (second + 1 < missing.size() && missing[second].packing <= missing[first].packing) ++second;
  const double rise = (missing[second].pressure - missing[first].pressure) / (missing[second].packing - missing[first].packing);
  const double lowest = first > 0 ? std::max(missing[first - 1].packing, 1e-6) : 0.25 * missing[first].packing;
  const double onset = rise > 0.0 ? std::max(lowest, missing[first].packing - missing[first].pressure / rise) : lowest;
  const double last = missing.back().packing;
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
