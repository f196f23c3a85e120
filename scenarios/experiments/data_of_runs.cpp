#include "scenarios/experiments/data_of_runs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/numbers/number_text.h"
#include "scenarios/calibrate/zero_rate.h"
#include "scenarios/experiments/found_curves.h"

namespace morula::scenarios {
namespace {

constexpr int kPlaces = 50;              // of a curve, on the way in and on the way out
constexpr double kLoosest = 1.1;         // V/V0 of the first point of a packing
constexpr double kAtRest = 0.02;         // part of its way that a relaxed pair may still come in the last tenth of its time
constexpr double kClusterAtRest = 0.01;  // of R: as much as the distances of a cluster may be wrong
constexpr double kNoForce = 0.01;        // of the largest force: a pair that bears less has parted

/// A pair at one rate, by the way of its traps.
struct Curve {
  const Experiment* experiment = nullptr;
  std::vector<FoundPair> points;

  /// Between the two outputs around this part of the way in (0 to 1) or out (1 to 2).
  [[nodiscard]] FoundPair at(double way) const {
    const double turn = experiment->turn, end = points.back().time;
    const double time = way <= 1.0 ? way * turn : turn + (way - 1.0) * (end - turn);
    const auto after = std::ranges::lower_bound(points, time, {}, &FoundPair::time);
    if (after == points.begin()) return points.front();
    if (after == points.end()) return points.back();
    const FoundPair &a = *(after - 1), &b = *after;
    const double part = (time - a.time) / (b.time - a.time);
    const auto mix = [part](double from, double to) { return from + part * (to - from); };
    return {time, mix(a.overlap, b.overlap), mix(a.force, b.force), mix(a.area, b.area), a.touching && b.touching};
  }
  [[nodiscard]] double largest_force() const {
    double out = 0.0;
    for (const FoundPair& p : points) out = std::max(out, std::abs(p.force));
    return out;
  }
};

/// One number of all rates at one place of the way, at no rate.
template <class Number>
Result<calibrate::AtRest> at_rest(const std::vector<Curve>& curves, double way, double scale, const Number& number) {
  std::vector<calibrate::RateSample> samples;
  for (const Curve& curve : curves) samples.push_back({curve.experiment->rate, number(curve.at(way))});
  return calibrate::to_zero_rate(samples, scale);
}

Status add_pair(const std::vector<Curve>& curves, int block, ExperimentData& out) {
  const Experiment& first = *curves.front().experiment;
  const double force_scale = curves.front().largest_force();
  if (!(force_scale > 0.0)) {
    out.remarks.push_back(first.name + ": the cells bear no force");
    return {};
  }
  const double length = std::min(first.radius_a, first.radius_b);
  std::size_t bent = 0, all = 0;
  for (int k = 0; k < 2 * kPlaces; ++k) {
    const double way = (k + 0.5) / kPlaces;
    const bool touching = std::ranges::all_of(curves, [&](const Curve& c) { return c.at(way).touching; });
    if (!touching) continue;
    MORULA_TRY_ASSIGN(const auto overlap, at_rest(curves, way, length, [](const FoundPair& p) { return p.overlap; }));
    MORULA_TRY_ASSIGN(const auto force, at_rest(curves, way, force_scale, [](const FoundPair& p) { return p.force; }));
    MORULA_TRY_ASSIGN(const auto area, at_rest(curves, way, length * length, [](const FoundPair& p) { return p.area; }));
    if (std::abs(force.value) < kNoForce * force_scale && overlap.value < 0.0) continue;  // parted; only the range counts as touching
    ++all;
    bent += force.straight ? 0 : 1;
    if (curves.size() > 2) out.largest_remainder = std::max(out.largest_remainder, force.remainder);
    out.points.pairs.push_back({.experiment = block + (way > 1.0 ? 1 : 0),
                                .overlap = overlap.value,
                                .force = force.value,
                                .area = area.value,
                                .radius_a = first.radius_a,
                                .radius_b = first.radius_b,
                                .rate = curves.back().experiment->rate,
                                .held_out = first.held_out});
  }
  if (curves.size() == 2)
    out.remarks.push_back(first.name + ": two rates only, which do not tell whether the force is straight in the rate");
  else if (bent > 0)
    out.remarks.push_back("cells of " + number_text("%.4g", first.radius_a) + " and " + number_text("%.4g", first.radius_b) + " um: at " +
                          std::to_string(bent) + " of " + std::to_string(all) +
                          " places the force is not straight in the rate within 2 % of the largest (contact lines jump from node to node)");
  return {};
}

/// With a remark where the cells still moved at the end.
void add_cluster(const Experiment& experiment, FoundCluster cluster, int block, ExperimentData& out) {
  if (cluster.still > kClusterAtRest * cluster.radius)
    out.remarks.push_back(experiment.name + ": the cells still moved at the end, by up to " +
                          number_text("%.2g", cluster.still / cluster.radius) + " R in its last tenth");
  out.points.clusters.push_back({.experiment = block,
                                 .places = calibrate::geometry_of_cluster(cluster.centers, cluster.radius),
                                 .radius = cluster.radius,
                                 .held_out = cluster.held_out});
  out.clusters.push_back(std::move(cluster));
}

/// With a remark where the cells still moved at the end.
void add_relaxation(const Experiment& experiment, calibrate::Relaxation pair, ExperimentData& out) {
  const std::size_t n = pair.overlap.size();
  const double end = n > 0 ? pair.overlap.back() : 0.0, late = n > 0 ? pair.overlap[n - 1 - n / 10] : 0.0;
  if (!(end > 0.0)) {
    out.remarks.push_back(experiment.name + ": the cells did not come together by themselves");
    return;
  }
  if (std::abs(end - late) > kAtRest * end)
    out.remarks.push_back(experiment.name + ": the cells still moved at the end, by " +
                          number_text("%.2g", 100.0 * std::abs(end - late) / end) + " % of their way in its last tenth");
  out.relaxations.push_back(std::move(pair));
}

}  // namespace

Result<ExperimentData> data_of_runs(std::span<const Experiment> experiments, std::span<const ExperimentOutcome> outcomes) {
  ExperimentData out;
  std::map<std::pair<double, double>, std::vector<Curve>> pairs;
  int block = 0;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const Experiment& experiment = experiments[e];
    if (experiment.kind == Experiment::Kind::kMixedPair) continue;  // these come after the fit
    if (!outcomes[e].done) {
      out.remarks.push_back(experiment.name + " is missing: " + outcomes[e].problem);
      continue;
    }
    if (experiment.kind == Experiment::Kind::kPair) {
      MORULA_TRY_ASSIGN(auto points, pair_of_run(experiment, outcomes[e].run));
      if (points.size() > 1) pairs[{experiment.radius_a, experiment.radius_b}].push_back({&experiment, std::move(points)});
    } else if (experiment.kind == Experiment::Kind::kRelaxation) {
      MORULA_TRY_ASSIGN(auto pair, relaxation_of_run(experiment, outcomes[e].run));
      add_relaxation(experiment, std::move(pair), out);
    } else if (experiment.kind == Experiment::Kind::kCluster) {
      MORULA_TRY_ASSIGN(auto cluster, cluster_of_run(experiment, outcomes[e].run));
      add_cluster(experiment, std::move(cluster), block++, out);
    } else if (experiment.kind == Experiment::Kind::kPressed) {
      MORULA_TRY_ASSIGN(auto pressed, pressed_of_run(experiment, outcomes[e].run));
      out.pressed.push_back(std::move(pressed));
      out.pressed_seeds.push_back(experiment.seed);
    } else {
      MORULA_TRY_ASSIGN(const auto points, packing_of_run(experiment, outcomes[e].run));
      for (const FoundPacking& point : points) {
        if (point.volume_ratio > kLoosest) continue;
        out.packings.push_back(point);
        out.points.packings.push_back({.experiment = block,
                                       .arrangement = experiment.arrangement,
                                       .volume_ratio = point.volume_ratio,
                                       .pressure = point.pressure,
                                       .radius = experiment.radius_a,
                                       .held_out = experiment.held_out,
                                       .random = {},
                                       .contact_area = point.contact_area});
      }
      ++block;
    }
  }
  for (const auto& [radii, curves] : pairs) {
    if (curves.size() < 2) {
      out.remarks.push_back(curves.front().experiment->name + ": a single rate cannot be extrapolated to none; left out");
      continue;
    }
    MORULA_TRY(add_pair(curves, block, out));
    block += 2;
  }
  if (std::ranges::none_of(out.points.pairs, [](const auto& p) { return !p.held_out; }))
    return Error{ErrorKind::kInput, "there is no pair of cells to fit to", out.remarks.empty() ? "" : out.remarks.front()};
  return out;
}

}  // namespace morula::scenarios
