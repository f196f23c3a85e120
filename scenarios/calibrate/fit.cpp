#include "scenarios/calibrate/fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numbers/number_text.h"
#include "core/random/philox.h"
#include "scenarios/calibrate/knots.h"
#include "scenarios/calibrate/pair_model.h"
#include "scenarios/calibrate/streams.h"
#include "scenarios/calibrate/table_fit.h"

namespace morula::calibrate {
namespace {

Error refused(std::string what, std::string help) { return Error{ErrorKind::kInput, std::move(what), std::move(help)}; }

Status check(const Data& data, const FitOptions& options) {
  int fitted = 0;
  for (std::size_t k = 0; k < data.pairs.size(); ++k) {
    const PairPoint& point = data.pairs[k];
    if (!std::isfinite(point.overlap) || !std::isfinite(point.force) || !(point.radius_a > 0.0) || !(point.radius_b > 0.0))
      return refused("pair point " + std::to_string(k) + " of experiment " + std::to_string(point.experiment) +
                         " has an overlap, a force or a radius that is no sound number",
                     "leave the experiment out, or run it again");
    fitted += is_fitted(point, options.weights);
  }
  for (std::size_t k = 0; k < data.packings.size(); ++k) {
    const PackingPoint& point = data.packings[k];
    if (!std::isfinite(point.pressure) || !(point.volume_ratio > 0.0) || !(point.radius > 0.0))
      return refused("packing point " + std::to_string(k) + " of experiment " + std::to_string(point.experiment) +
                         " has a pressure, a room or a radius that is no sound number",
                     "leave the experiment out, or run it again");
  }
  if (fitted < 3)
    return refused("E and W need three points of pairs at least, with overlaps up to " +
                       number_text("%.3g", options.weights.overlap_limit) + " R, and there are " + std::to_string(fitted),
                   "more points of the approach and the pull-off");
  for (std::size_t k = 0; k < options.packing.size(); ++k)
    if (!(options.packing[k] > (k == 0 ? 0.0 : options.packing[k - 1])))
      return refused("the packing of the knots must be above 0 and increase, and knot " + std::to_string(k) + " has " +
                         number_text("%.6g", options.packing[k]),
                     "sort the knots");
  if (!options.packing.empty() && options.packing.size() < 3) return refused("a packing curve needs three knots at least", "more of them");
  return {};
}

/// E and W from pairs, of many starts the best.
Minimum search_pairs(const LeastSquares& loss, const FitOptions& options, Fit& out) {
  const Random random(options.seed, kStartStream);
  std::vector<Minimum> found;
  for (int k = 0; k < std::max(1, options.starts); ++k) {
    const RandomPair u = random.uniform(CellId{}, static_cast<std::uint64_t>(k));
    const std::vector<double> start{std::log(0.05) + u.first * std::log(5.0 / 0.05), std::log(1e-3) + u.second * std::log(1.0 / 1e-3)};
    found.push_back(minimise(loss, start));
  }
  const auto best = std::min_element(found.begin(), found.end(), [](const Minimum& a, const Minimum& b) { return a.loss < b.loss; });
  out.starts = static_cast<int>(found.size());
  for (const Minimum& one : found)
    out.agreeing += std::abs(one.parameters[0] - best->parameters[0]) < 1e-4 && std::abs(one.parameters[1] - best->parameters[1]) < 1e-4;
  return *best;
}

constexpr int kKnotsOfToe = 2;  // that a curve has more where clusters tell how it begins

/// φ of two cells at rest, or as deep as pairs are fitted, up to which pairs know all that acts between two; 0: there is no cluster that tells what neighbours do to each other
/// from there on.
double onset_by_pairs(const Data& data, const PairModel& pair, const LossWeights& weights) {
  const auto fitted = std::ranges::find(data.clusters, false, &ClusterPoint::held_out);
  if (fitted == data.clusters.end()) return 0.0;
  return packing_of_pair(std::max(resting_overlap(pair, fitted->radius) / fitted->radius, weights.overlap_limit));
}

/// The curve with E and W as they are.
void add_curve(const Data& data, const FitOptions& options, Fit& out) {
  const bool any = std::any_of(data.packings.begin(), data.packings.end(), [](const PackingPoint& point) { return !point.held_out; });
  out.parameters.knots = fit_curve(data, jkr_model(out.parameters.young, out.poisson, out.parameters.adhesion), options);
  if (!any)
    out.remarks.push_back("no packings were given: the fit has no packing curve");
  else if (out.parameters.knots.empty())
    out.remarks.push_back("pairs alone bear the pressure of the packings, or too few packings tell: the fit has no packing curve");
}

void polish(const LeastSquares& loss, Fit& out) {
  const Minimum end = minimise(loss, out.parameters.logarithms());
  out.parameters = Parameters::of(end.parameters, out.parameters.knots);
  out.loss = end.loss, out.converged = end.converged;
  std::vector<double> residuals;
  loss.residuals(end.parameters, residuals);
  out.residuals = residuals.size();
}

void remark_on_bounds(Fit& fit) {
  const auto at = [](double x, double bound) { return std::abs(std::log(x / bound)) < 1e-3; };
  for (const double bound : Bounds::kYoung)
    if (at(fit.parameters.young, bound)) fit.remarks.push_back("E is at the bound " + number_text("%.3g kPa", bound) + " of the search");
  for (const double bound : Bounds::kAdhesion)
    if (at(fit.parameters.adhesion, bound))
      fit.remarks.push_back("W is at the bound " + number_text("%.3g nN/um", bound) + " of the search");
  if (!fit.scales.pulls) fit.remarks.push_back("no fitted pair pulls: E and W are told apart badly without a pull-off");
}

}  // namespace

double Fit::dispersion() const {
  const double free = static_cast<double>(residuals) - static_cast<double>(parameters.logarithms().size());
  return free > 0.0 ? std::max(1.0, loss / free) : 1.0;
}

double Fit::modulus() const { return pair_modulus(parameters.young, poisson); }

double Fit::pull_off(double reduced_radius) const { return 1.5 * std::numbers::pi * parameters.adhesion * reduced_radius; }

LeastSquares loss_of(const Data& data, const Fit& fit) { return loss_of(data, fit.poisson, fit.weights, fit.scales, fit.parameters.knots); }

std::vector<cbm::PackingKnot> fit_curve(const Data& data, const PairModel& pair, const FitOptions& options) {
  if (std::ranges::all_of(data.packings, &PackingPoint::held_out)) return {};
  const std::vector<MissingPressure> missing = missing_pressure(data, pair);
  const double onset = onset_by_pairs(data, pair, options.weights);
  const std::vector<double> packing =
      options.packing.empty() ? place_knots(missing, options.knots + (onset > 0.0 ? kKnotsOfToe : 0), onset) : options.packing;
  if (missing.empty() || packing.empty()) return {};
  const std::vector<cbm::PackingKnot> knots = first_curve(missing, packing);
  std::vector<double> start = Parameters{1.0, 1.0, knots}.logarithms();
  const Minimum found = minimise(loss_of_curve(data, pair, options.weights, knots), std::span<const double>(start).subspan(2));
  std::copy(found.parameters.begin(), found.parameters.end(), start.begin() + 2);
  return Parameters::of(start, knots).knots;
}

Result<Fit> fit(const Data& data, const FitOptions& options) {
  MORULA_TRY(check(data, options));
  Fit out;
  out.poisson = options.poisson, out.weights = options.weights;
  out.scales = scales_of(data, options.weights);
  if (!(out.scales.pull_off > 0.0))
    return refused("all fitted pair points have no force: they tell nothing about E and W", "points of the approach and the pull-off");
  const LeastSquares pairs = loss_of(data, out.poisson, out.weights, out.scales, {});
  out.parameters = Parameters::of(search_pairs(pairs, options, out).parameters, {});
  add_curve(data, options, out);
  polish(loss_of(data, out), out);
  remark_on_bounds(out);
  return out;
}

Fit fit_again(const Data& data, const Fit& from) {
  Fit out = from;
  polish(loss_of(data, from), out);
  return out;
}

}  // namespace morula::calibrate
