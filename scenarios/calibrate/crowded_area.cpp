#include "scenarios/calibrate/crowded_area.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/ball.h"

namespace morula::calibrate {
namespace {

constexpr std::size_t kKnots = 8;
constexpr double kApart = 0.01;  // least way between the knots, of the part that pairs say

/// By the part that pairs say.
std::vector<CrowdedPoint> points_of(std::span<const PackingPoint> packings) {
  std::vector<CrowdedPoint> out;
  for (const PackingPoint& p : packings) {
    if (p.arrangement != Arrangement::kRandom) continue;
    const double surface = ball_surface(p.radius);
    if (p.contact_area > 0.0 && p.random.contact_area > 0.0)
      out.push_back({{p.random.contact_area / surface, p.contact_area / surface}, p.held_out});
  }
  std::ranges::sort(out, {}, &CrowdedPoint::pairs);
  return out;
}

/// Means of points that follow one another.
std::vector<cbm::CrowdedKnot> means_of(const std::vector<CrowdedPoint>& sorted) {
  std::vector<cbm::CrowdedKnot> out;
  for (std::size_t k = 0; k < kKnots; ++k) {
    cbm::CrowdedKnot sum;
    const std::size_t first = k * sorted.size() / kKnots, last = (k + 1) * sorted.size() / kKnots;
    for (std::size_t i = first; i < last; ++i) sum.pairs += sorted[i].pairs, sum.cells += sorted[i].cells;
    const auto count = static_cast<double>(last - first);
    if (last > first) out.push_back({sum.pairs / count, sum.cells / count});
  }
  return out;
}

double rms_error(const std::vector<CrowdedPoint>& points, const cbm::CrowdedArea& curve) {
  double sum = 0.0;
  for (const CrowdedPoint& p : points) sum += std::pow(curve.at(p.pairs) / p.cells - 1.0, 2);
  return points.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace

double resting_share(const PairModel& pair, double radius) {
  const double rest = resting_overlap(pair, radius);
  return rest > 0.0 ? pair(rest, 0.5 * radius).area / ball_surface(radius) : 0.0;
}

FittedCrowding fit_crowded_area(std::span<const PackingPoint> packings, double resting_share) {
  FittedCrowding out;
  std::vector<CrowdedPoint> fitted, judged;
  for (const CrowdedPoint& p : points_of(packings)) (p.held_out ? judged : fitted).push_back(p);
  if (fitted.empty()) return out;
  if (resting_share > 0.0) out.knots.push_back({resting_share, resting_share});
  for (const cbm::CrowdedKnot& mean : means_of(fitted))
    if (out.knots.empty() || mean.pairs > out.knots.back().pairs + kApart) out.knots.push_back(mean);
  const auto curve = cbm::CrowdedArea::through(out.knots);
  if (!curve.ok()) return {};
  out.packings = static_cast<int>(judged.size());
  out.held_out = rms_error(judged, *curve);
  out.pairs_alone = rms_error(judged, {});
  out.points = std::move(fitted);
  out.points.insert(out.points.end(), judged.begin(), judged.end());
  return out;
}

}  // namespace morula::calibrate
