#include "scenarios/calibrate/table_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace morula::calibrate {
namespace {

/// An average of points of the table; areas are counted apart, since not all points have one.
struct Group {
  double overlap = 0.0, force = 0.0, area = 0.0;
  double points = 0.0, areas = 0.0;

  void add(const Group& other) {
    const double all = points + other.points, with_area = areas + other.areas;
    overlap = (points * overlap + other.points * other.overlap) / all;
    force = (points * force + other.points * other.force) / all;
    if (with_area > 0.0) area = (areas * area + other.areas * other.area) / with_area;
    points = all, areas = with_area;
  }
};

constexpr double kNearLargest = 0.75;
constexpr double kAtRest = 50.0;      // points that one of a pair at rest counts
constexpr double kMostPacked = 0.95;  // of the force of a pair, whatever packing adds: the rest is the table's

/// Where pairs come to rest by themselves, with no force: the mean of δ/R*, and what packing adds there; no points: none was run.
Group at_rest(const Data& data, const cbm::PackingCurve& packing) {
  Group out;
  for (const ClusterPoint& point : data.clusters) {
    if (point.held_out || !point.is_pair()) continue;
    const double r = 0.5 * point.radius, overlap = point.overlap_of_pair();
    out.add({overlap / r, -packing_force_of_pair(packing, point.radius, point.radius, overlap) / r, 0.0, kAtRest, 0.0});
  }
  return out;
}

/// Scaled points by overlap, from where the tension is near its largest on, neighbours closer than a hundredth of the range together. Contact lines jump, so
/// that the largest tension of all may stand anywhere between: pulled further apart, such pairs go on to hold most of it.
std::vector<Group> scaled_points(const Data& data, const cbm::PackingCurve& packing) {
  std::vector<Group> all;
  const Group rest = at_rest(data, packing);
  if (rest.points > 0.0) all.push_back(rest);
  for (const PairPoint& point : data.pairs) {
    if (point.held_out) continue;
    const double r = point.reduced_radius();
    if (rest.points > 0.0 && point.force < 0.0 && point.overlap > rest.overlap * r)
      continue;  // held by a contact line that does not let go
    const bool has_area = std::isfinite(point.area);
    const double packed = packing_force_of_pair(packing, point.radius_a, point.radius_b, point.overlap);
    const double force = point.force - std::min(packed, kMostPacked * std::abs(point.force));
    all.push_back({point.overlap / r, force / r, has_area ? point.area / (r * r) : 0.0, 1.0, has_area ? 1.0 : 0.0});
  }
  std::stable_sort(all.begin(), all.end(), [](const Group& a, const Group& b) { return a.overlap < b.overlap; });
  const auto least = std::min_element(all.begin(), all.end(), [](const Group& a, const Group& b) { return a.force < b.force; });
  const auto first = least == all.end() || least->force >= 0.0
                         ? least
                         : std::find_if(all.begin(), least, [&](const Group& a) { return a.force < kNearLargest * least->force; });
  std::vector<Group> out;
  double begin = 0.0;
  for (auto at = first; at != all.end(); ++at) {
    // The break stays what it is.
    if (out.size() > 1 && at->overlap - begin < 0.01 * (all.back().overlap - first->overlap)) {
      out.back().add(*at);
    } else {
      out.push_back(*at);
      begin = at->overlap;
    }
  }
  return out;
}

/// Neighbours that do not rise become their average (Ayer et al. 1955, doi:10.1214/aoms/1177728423).
std::vector<Group> made_to_rise(const std::vector<Group>& points) {
  std::vector<Group> out;
  for (const Group& point : points) {
    out.push_back(point);
    while (out.size() > 1 && !(out[out.size() - 2].force < out.back().force)) {
      out[out.size() - 2].add(out.back());
      out.pop_back();
    }
  }
  return out;
}

/// At most this many, the first and the last as they are and those between in groups of neighbours.
std::vector<Group> thinned(const std::vector<Group>& points, int most) {
  const auto limit = static_cast<std::size_t>(std::max(3, most));
  if (points.size() <= limit) return points;
  std::vector<Group> out{points.front()};
  const std::size_t inner = points.size() - 2, groups = limit - 2;
  for (std::size_t g = 0; g < groups; ++g) {
    Group group;
    for (std::size_t k = g * inner / groups; k < (g + 1) * inner / groups; ++k) group.add(points[k + 1]);
    out.push_back(group);
  }
  out.push_back(points.back());
  return out;
}

/// Areas that do not fall, as averages of neighbours; where none was measured, those of the neighbour before.
std::vector<double> rising_areas(const std::vector<Group>& points) {
  std::vector<std::pair<double, double>> blocks;  // mean and weight
  std::vector<std::size_t> length;
  for (const Group& point : points) {
    blocks.emplace_back(point.areas > 0.0 ? point.area : blocks.empty() ? 0.0 : blocks.back().first, std::max(point.areas, 1e-9));
    length.push_back(1);
    while (blocks.size() > 1 && blocks[blocks.size() - 2].first > blocks.back().first) {
      auto& [mean, weight] = blocks[blocks.size() - 2];
      const double all = weight + blocks.back().second;
      mean = (mean * weight + blocks.back().first * blocks.back().second) / all;
      weight = all;
      length[length.size() - 2] += length.back();
      blocks.pop_back(), length.pop_back();
    }
  }
  std::vector<double> out;
  for (std::size_t k = 0; k < blocks.size(); ++k) out.insert(out.end(), length[k], blocks[k].first);
  return out;
}

}  // namespace

Result<cbm::PairTable> fit_table(const Data& data, const cbm::PackingCurve& packing, int most) {
  const std::vector<Group> points = thinned(made_to_rise(scaled_points(data, packing)), most);
  const std::vector<double> areas = rising_areas(points);
  std::vector<cbm::PairTableKnot> knots;
  for (std::size_t k = 0; k < points.size(); ++k) knots.push_back({points[k].overlap, points[k].force, areas[k]});
  return cbm::PairTable::through(knots, knots.empty() ? 0.0 : std::max(0.0, knots.front().overlap));
}

PairModel table_model(cbm::PairTable table) {
  return [table = std::move(table)](double overlap, double reduced_radius) {
    const auto at = table.respond(reduced_radius, overlap, true);
    return PairAnswer{at.force, at.area};
  };
}

ForceExponent force_exponent(const Data& data, const cbm::PairTable& table) {
  double largest = 0.0;
  for (const PairPoint& point : data.pairs)
    if (!point.held_out) largest = std::max(largest, point.force / point.reduced_radius());
  std::vector<std::pair<double, double>> logs;
  double x_sum = 0.0, y_sum = 0.0;
  for (const PairPoint& point : data.pairs) {
    const double r = point.reduced_radius(), over = point.overlap / r - table.rest_overlap();
    if (point.held_out || !(point.force > 0.05 * largest * r) || !(over > 0.0)) continue;
    logs.emplace_back(std::log(over), std::log(point.force / r));
    x_sum += logs.back().first, y_sum += logs.back().second;
  }
  ForceExponent out{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(), static_cast<int>(logs.size())};
  if (logs.size() < 3) return out;
  const auto n = static_cast<double>(logs.size());
  double xx = 0.0, xy = 0.0, rest = 0.0;
  for (const auto& [x, y] : logs) xx += (x - x_sum / n) * (x - x_sum / n), xy += (x - x_sum / n) * (y - y_sum / n);
  if (!(xx > 0.0)) return out;
  out.value = xy / xx;
  for (const auto& [x, y] : logs) rest += std::pow(y - y_sum / n - out.value * (x - x_sum / n), 2);
  out.error = std::sqrt(rest / (n - 2.0) / xx);
  return out;
}

double misfit_share(const Data& data, const Fit& fit) {
  const LeastSquares loss = loss_of(data, fit.poisson, fit.weights, fit.scales, {});
  std::vector<double> residuals;
  loss.residuals(Parameters{fit.parameters.young, fit.parameters.adhesion, {}}.logarithms(), residuals);
  double sum = 0.0;
  for (const double r : residuals) sum += r * r;
  return sum > 0.0 ? std::max(0.0, 1.0 - (static_cast<double>(residuals.size()) - 2.0) / sum) : 0.0;
}

}  // namespace morula::calibrate
