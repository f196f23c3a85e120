#include "scenarios/calibrate/held_out.h"

#include <algorithm>
#include <cmath>

#include "scenarios/calibrate/lattice.h"

namespace morula::calibrate {

HeldOutErrors held_out_errors(const Data& data, const PairModel& pair, const cbm::PackingCurve& curve, double pull_off) {
  HeldOutErrors out;
  for (const PairPoint& point : data.pairs) {
    if (!point.held_out) continue;
    const double r = point.reduced_radius(), error = std::abs(point.force - pair(point.overlap, r).force) / (pull_off * r);
    ++out.pairs;
    out.force_rms += error * error, out.force_worst = std::max(out.force_worst, error);
  }
  double largest = 0.0;
  for (const PackingPoint& point : data.packings) largest = std::max(largest, std::abs(point.pressure));
  for (const PackingPoint& point : data.packings) {
    if (!point.held_out) continue;
    const LatticeGeometry at = lattice_geometry(point.lattice, point.volume_ratio);
    const double law = pair_pressure(at, point.radius, pair) + at.press * curve.at(at.packing).pressure;
    const double error = std::abs(point.pressure - law) / std::max(std::abs(point.pressure), 0.1 * largest);
    ++out.packings;
    out.pressure_rms += error * error, out.pressure_worst = std::max(out.pressure_worst, error);
  }
  if (out.pairs > 0) out.force_rms = std::sqrt(out.force_rms / out.pairs);
  if (out.packings > 0) out.pressure_rms = std::sqrt(out.pressure_rms / out.packings);
  return out;
}

}  // namespace morula::calibrate
