#include <algorithm>
#include <cmath>
#include <map>

#include "scenarios/calibrate/confidence.h"
#include "scenarios/calibrate/streams.h"

namespace morula::calibrate {
namespace {

/// Points that are not held out, by their experiment.
template <class Point>
std::vector<std::vector<Point>> blocks_of(const std::vector<Point>& points) {
  std::map<int, std::vector<Point>> by_experiment;
  for (const Point& point : points)
    if (!point.held_out) by_experiment[point.experiment].push_back(point);
  std::vector<std::vector<Point>> out;
  for (auto& [number, block] : by_experiment) out.push_back(std::move(block));
  return out;
}

/// As many blocks as there are, drawn with replacement; draws are numbered on from `draw`.
template <class Point>
void draw_blocks(const std::vector<std::vector<Point>>& blocks, const Random& random, CellId sample, std::uint64_t& draw,
                 std::vector<Point>& out) {
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const double u = random.uniform(sample, draw++).first;
    const std::vector<Point>& block = blocks[std::min(blocks.size() - 1, static_cast<std::size_t>(u * static_cast<double>(blocks.size())))];
    out.insert(out.end(), block.begin(), block.end());
  }
}

/// Percentiles 2.5 and 97.5, interpolated between the samples.
Interval percentiles(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double part) {
    const double place = part * static_cast<double>(values.size() - 1);
    const auto k = static_cast<std::size_t>(place);
    return k + 1 < values.size() ? values[k] + (place - static_cast<double>(k)) * (values[k + 1] - values[k]) : values.back();
  };
  return {at(0.025), at(0.975)};
}

}  // namespace

Bootstrap bootstrap(const Data& data, const Fit& fit, int samples, std::uint32_t seed) {
  const auto pairs = blocks_of(data.pairs);
  const auto packings = blocks_of(data.packings);
  const auto clusters = blocks_of(data.clusters);
  Bootstrap out;
  if (pairs.size() < 2 || samples < 2) return out;
  out.possible = true, out.samples = samples;
  const Random random(seed, kResampleStream);
  std::vector<double> young, adhesion;
  std::vector<std::vector<double>> pressure(fit.parameters.knots.size());
  for (int sample = 0; sample < samples; ++sample) {
    Data drawn;
    std::uint64_t draw = 0;
    draw_blocks(pairs, random, CellId(static_cast<std::uint64_t>(sample)), draw, drawn.pairs);
    draw_blocks(packings, random, CellId(static_cast<std::uint64_t>(sample)), draw, drawn.packings);
    draw_blocks(clusters, random, CellId(static_cast<std::uint64_t>(sample)), draw, drawn.clusters);
    const Parameters found = fit_again(drawn, fit).parameters;
    out.logarithms.push_back(found.logarithms());
    young.push_back(found.young), adhesion.push_back(found.adhesion);
    for (std::size_t k = 0; k < pressure.size(); ++k) pressure[k].push_back(found.knots[k].pressure);
  }
  out.young = percentiles(young), out.adhesion = percentiles(adhesion);
  for (const std::vector<double>& knot : pressure) out.pressure.push_back(percentiles(knot));
  return out;
}

Result<SureFit> fit_with_confidence(const Data& data, const FitOptions& options, int samples) {
  MORULA_TRY_ASSIGN(Fit best, fit(data, options));
  SureFit out;
  for (int round = 0; round < 4; ++round) {
    out.young = profile(data, best, 0);
    out.adhesion = profile(data, best, 1);
    const std::vector<double>& better = out.young.better.empty() ? out.adhesion.better : out.young.better;
    if (better.empty()) break;
    best.parameters = Parameters::of(better, best.parameters.knots);
    best = fit_again(data, best);
  }
  out.covariance = covariance(data, best);
  out.bootstrap = bootstrap(data, best, samples, options.seed);
  out.fit = std::move(best);
  return out;
}

}  // namespace morula::calibrate
