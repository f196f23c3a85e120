#include "scenarios/calibrate/held_out.h"

#include <algorithm>
#include <cmath>

namespace morula::calibrate {

HeldOutErrors held_out_errors(const Data& data, const PairModel& pair, const cbm::PackingCurve& curve, double pull_off) {
  HeldOutErrors out;
  for (const PairPoint& point : data.pairs) {
    if (!point.held_out) continue;
    const double r = point.reduced_radius();
    const double law = pair(point.overlap, r).force + packing_force_of_pair(curve, point.radius_a, point.radius_b, point.overlap);
    const double error = std::abs(point.force - law) / (pull_off * r);
    ++out.pairs;
    out.force_rms += error * error, out.force_worst = std::max(out.force_worst, error);
  }
  double largest = 0.0;
  for (const PackingPoint& point : data.packings) largest = std::max(largest, std::abs(point.pressure));
  for (const PackingPoint& point : data.packings) {
    if (!point.held_out) continue;
    const PackingGeometry at = point.geometry();
    const double law = pair_pressure(at, point.radius, pair) + curve_pressure(at, curve);
    const double error = std::abs(point.pressure - law) / std::max(std::abs(point.pressure), 0.1 * largest);
    out.all_packings.push_back({point.arrangement, point.volume_ratio, point.pressure, law});
    const bool random = point.arrangement == Arrangement::kRandom;
    ++(random ? out.packings : out.lattices);
    (random ? out.pressure_rms : out.lattice_rms) += error * error;
    double& worst = random ? out.pressure_worst : out.lattice_worst;
    worst = std::max(worst, error);
  }
  if (out.pairs > 0) out.force_rms = std::sqrt(out.force_rms / out.pairs);
  if (out.packings > 0) out.pressure_rms = std::sqrt(out.pressure_rms / out.packings);
  if (out.lattices > 0) out.lattice_rms = std::sqrt(out.lattice_rms / out.lattices);
  return out;
}

}  // namespace morula::calibrate
