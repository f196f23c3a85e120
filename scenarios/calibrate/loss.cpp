#include "scenarios/calibrate/loss.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <utility>

#include "scenarios/calibrate/pair_model.h"

namespace morula::calibrate {
namespace {

/// A packing and where its cells lie, computed once.
struct PlacedPacking {
  PackingPoint point;
  PackingGeometry at;
};

std::vector<PlacedPacking> placed(const Data& data) {
  std::vector<PlacedPacking> out;
  for (const PackingPoint& point : data.packings)
    if (!point.held_out) out.push_back({point, point.geometry()});
  return out;
}

/// Cells of which none touches another tell nothing.
std::vector<ClusterPoint> fitted_clusters(const Data& data) {
  std::vector<ClusterPoint> out;
  std::ranges::copy_if(data.clusters, std::back_inserter(out),
                       [](const ClusterPoint& point) { return !point.held_out && !point.places.neighbours.empty(); });
  return out;
}

/// What a law of pairs says of the data; the knots have no part in it.
struct OfPairs {
  double modulus = 0.0, adhesion = 0.0;
  std::vector<double> residuals;  ///< of pairs
  std::vector<double> pressures;  ///< in packings, and then in clusters, without what a curve adds [kPa]
};

struct Loss {
  std::vector<PairPoint> pairs;
  std::vector<PlacedPacking> packings;
  std::vector<ClusterPoint> clusters;
  double poisson = 0.0;
  LossWeights weights;
  DataScales scales;
  std::vector<cbm::PackingKnot> knots;
  mutable OfPairs last;  ///< most searches and differences change the knots alone

  [[nodiscard]] std::vector<double> pressures_by(const PairModel& pair) const {
    std::vector<double> out;
    for (const PlacedPacking& packing : packings) out.push_back(pair_pressure(packing.at, packing.point.radius, pair));
    for (const ClusterPoint& cluster : clusters) out.push_back(pair_pressure(cluster.places, cluster.radius, pair));
    return out;
  }
  /// Of the pressure in a cluster [kPa].
  [[nodiscard]] double noise_of(const ClusterPoint& cluster) const {
    const double force = scales.stiffness * weights.distance * cluster.radius;
    return pair_pressure(cluster.places, cluster.radius, [force](double, double) { return PairAnswer{force, 0.0}; });
  }

  /// JKR on all points.
  [[nodiscard]] const OfPairs& pairs_by(double modulus, double adhesion) const {
    if (modulus == last.modulus && adhesion == last.adhesion) return last;
    last = {modulus, adhesion, {}, {}};
    for (const PairPoint& point : pairs) {
      const double r = point.reduced_radius();
      const PairAnswer law = jkr_pair(modulus, adhesion, r, point.overlap, scales.stiffness);
      last.residuals.push_back((point.force - law.force) /
                               (weights.force_floor * scales.pull_off * r + weights.force_relative * std::abs(point.force)));
      if (std::isfinite(point.area) && scales.area > 0.0)
        last.residuals.push_back(std::sqrt(weights.area) * (point.area - law.area) / (weights.area_floor * scales.area * r * r));
    }
    last.pressures = pressures_by([&](double overlap, double r) { return jkr_pair(modulus, adhesion, r, overlap, scales.stiffness); });
    return last;
  }

  /// With the knots of the parameters, which rise.
  void add_packings(std::span<const double> of_pairs, std::span<const cbm::PackingKnot> risen, std::vector<double>& out) const {
    const Result<cbm::PackingCurve> through = cbm::PackingCurve::through(risen);
    assert(through.ok());
    const cbm::PackingCurve& curve = through.value();
    for (std::size_t k = 0; k < packings.size(); ++k) {
      const PlacedPacking& packing = packings[k];
      const double p = of_pairs[k] + curve_pressure(packing.at, curve);
      out.push_back(std::sqrt(weights.packing) * (packing.point.pressure - p) /
                    (weights.pressure_floor + weights.pressure_relative * std::abs(packing.point.pressure)));
    }
    for (std::size_t k = 0; k < clusters.size(); ++k) {
      const double p = of_pairs[packings.size() + k] + curve_pressure(clusters[k].places, curve);
      out.push_back(std::sqrt(weights.packing) * p / noise_of(clusters[k]));
    }
    for (std::size_t k = 1; k + 1 < risen.size(); ++k) {
      const double bend = risen[k + 1].pressure - 2.0 * risen[k].pressure + risen[k - 1].pressure;
      out.push_back(std::sqrt(weights.roughness) * bend / weights.pressure_floor);
    }
  }

  void operator()(std::span<const double> logarithms, std::vector<double>& out) const {
    const Parameters parameters = Parameters::of(logarithms, knots);
    const OfPairs& by_law = pairs_by(pair_modulus(parameters.young, poisson), parameters.adhesion);
    out = by_law.residuals;
    if (!packings.empty() || !clusters.empty()) add_packings(by_law.pressures, parameters.knots, out);
  }
};

}  // namespace

bool is_fitted(const PairPoint& point, const LossWeights& weights) {
  return !point.held_out && point.overlap <= weights.overlap_limit * point.smaller_radius();
}

DataScales scales_of(const Data& data, const LossWeights& weights) {
  DataScales out;
  double force = 0.0, overlap = 0.0, tension = 0.0, largest = 0.0, least = 0.0;
  for (const PairPoint& point : data.pairs) {
    if (!is_fitted(point, weights)) continue;
    const double r = point.reduced_radius();
    force = std::max(force, std::abs(point.force)), overlap = std::max(overlap, std::abs(point.overlap));
    tension = std::max(tension, -point.force / r), largest = std::max(largest, std::abs(point.force) / r);
    if (std::isfinite(point.area) && (out.area == 0.0 || std::abs(point.force) / r < least))
      out.area = point.area / (r * r), least = std::abs(point.force) / r;
  }
  out.pulls = tension > 0.0;
  out.pull_off = out.pulls ? tension : largest;
  out.stiffness = overlap > 0.0 ? force / overlap : 0.0;
  return out;
}

std::vector<double> Parameters::logarithms() const {
  const auto bounded = [](double x, const double(&limits)[2]) { return std::log(std::clamp(x, limits[0], limits[1])); };
  std::vector<double> out{bounded(young, Bounds::kYoung), bounded(adhesion, Bounds::kAdhesion)};
  for (std::size_t k = 1; k < knots.size(); ++k) out.push_back(bounded(knots[k].pressure - knots[k - 1].pressure, Bounds::kIncrement));
  return out;
}

Parameters Parameters::of(std::span<const double> logarithms, std::span<const cbm::PackingKnot> knots) {
  Parameters out{std::exp(logarithms[0]), std::exp(logarithms[1]), {knots.begin(), knots.end()}};
  for (std::size_t k = 0; k < knots.size(); ++k)
    out.knots[k].pressure = k == 0 ? 0.0 : out.knots[k - 1].pressure + std::exp(logarithms[k + 1]);
  return out;
}

LeastSquares loss_of(const Data& data, double poisson, const LossWeights& weights, const DataScales& scales,
                     std::span<const cbm::PackingKnot> knots) {
  Loss loss;
  loss.poisson = poisson, loss.weights = weights, loss.scales = scales;
  loss.knots.assign(knots.begin(), knots.end());
  for (const PairPoint& point : data.pairs)
    if (is_fitted(point, weights)) loss.pairs.push_back(point);
  if (!knots.empty()) loss.packings = placed(data), loss.clusters = fitted_clusters(data);
  LeastSquares out;
  const auto bound = [&](const double(&limits)[2]) {
    out.low.push_back(std::log(limits[0]));
    out.high.push_back(std::log(limits[1]));
  };
  bound(Bounds::kYoung);
  bound(Bounds::kAdhesion);
  for (std::size_t k = 1; k < knots.size(); ++k) bound(Bounds::kIncrement);
  out.residuals = std::move(loss);
  return out;
}

LeastSquares loss_of_curve(const Data& data, const PairModel& pair, const LossWeights& weights, std::span<const cbm::PackingKnot> knots) {
  Loss loss;
  loss.weights = weights, loss.scales = scales_of(data, weights);
  loss.packings = placed(data), loss.clusters = fitted_clusters(data);
  loss.knots.assign(knots.begin(), knots.end());
  LeastSquares out;
  out.low.assign(knots.size() - 1, std::log(Bounds::kIncrement[0]));
  out.high.assign(knots.size() - 1, std::log(Bounds::kIncrement[1]));
  std::vector<double> of_pairs = loss.pressures_by(pair);
  out.residuals = [loss = std::move(loss), of_pairs = std::move(of_pairs)](std::span<const double> increments,
                                                                           std::vector<double>& residuals) {
    std::vector<double> all{0.0, 0.0};
    all.insert(all.end(), increments.begin(), increments.end());
    residuals.clear();
    loss.add_packings(of_pairs, Parameters::of(all, loss.knots).knots, residuals);
  };
  return out;
}

}  // namespace morula::calibrate
