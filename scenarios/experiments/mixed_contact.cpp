#include "scenarios/experiments/mixed_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <numbers>
#include <span>
#include <utility>

#include "core/parallel/threads.h"
#include "results/file_io.h"
#include "scenarios/experiments/calibration.h"
#include "scenarios/experiments/found_curves.h"

namespace morula::scenarios {
namespace {

constexpr std::array kStiffness = {0.25, 0.5, 1.0, 2.0, 4.0}, kAdhesion = {0.55, 0.7, 0.85, 1.0, 1.15};  // that are tried
constexpr double kWay = 0.01;  // of R: as much may neighbours move for what a force counts that is wrong by the scale of forces
constexpr int kPlaces = 60;    // of a comparison, on each way

/// Force over overlap on the way in or out.
class Branch {
 public:
  Branch(const std::vector<FoundPair>& points, double turn, bool in) {
    for (const FoundPair& p : points)
      if (in ? p.time <= turn : p.time >= turn) points_.push_back(p);
    std::ranges::stable_sort(points_, {}, &FoundPair::overlap);
  }
  [[nodiscard]] double deepest() const { return points_.empty() ? -1e300 : points_.back().overlap; }
  /// The least overlap from which on cells touch.
  [[nodiscard]] double first_touch() const {
    const auto apart = std::find_if(points_.rbegin(), points_.rend(), [](const FoundPair& p) { return !p.touching; });
    return apart == points_.rbegin() ? 1e300 : apart.base()->overlap;
  }
  /// At an overlap up to the deepest; further apart than all points there is none.
  [[nodiscard]] double force(double overlap) const {
    const auto after = std::ranges::lower_bound(points_, overlap, {}, &FoundPair::overlap);
    if (after == points_.begin()) return 0.0;
    if (after == points_.end()) return points_.back().force;
    const FoundPair &a = *(after - 1), &b = *after;
    return a.force + (b.force - a.force) * (overlap - a.overlap) / (b.overlap - a.overlap);
  }

 private:
  std::vector<FoundPair> points_;
};

struct Curves {
  Branch in, out;
  Curves(const std::vector<FoundPair>& points, double turn) : in(points, turn, true), out(points, turn, false) {}
};

Result<Curves> curves_of(const Experiment& experiment, const ExperimentOutcome& outcome) {
  MORULA_TRY_ASSIGN(const auto points, pair_of_run(experiment, outcome.run));
  return Curves(points, experiment.turn);
}

/// Two shells and two spheres of the same radii, which a sphere and a shell are held against.
class Comparison {
 public:
  /// deepest: overlap up to which every pair is known.
  Comparison(const Calibration& found, const Curves& shells, double reduced_radius, double deepest) {
    const calibrate::Fit& fit = found.sure.fit;
    const double adhesion = fit.parameters.adhesion, modulus = calibrate::pair_modulus(fit.parameters.young, fit.poisson);
    const double length = std::cbrt(std::pow(std::numbers::pi * adhesion / modulus, 2) * reduced_radius);  // X
    double least = std::max(-0.5 * length, shells.out.first_touch());
    if (found.table_is_better()) least = std::max(least, found.table->table.break_overlap() * reduced_radius);
    const double most = std::min({2.0 * length > 0.0 ? 2.0 * length : deepest, deepest, shells.in.deepest(), shells.out.deepest()});
    const auto law = found.law_to_take();
    for (int k = 0; k < kPlaces && most > least; ++k) {
      const double overlap = least + (most - least) * (k + 0.5) / kPlaces;
      Place& place = places_.emplace_back(Place{overlap, law(overlap, reduced_radius).force, shells.out.force(overlap), {}});
      if (overlap >= shells.in.first_touch()) place.shells_in = shells.in.force(overlap);
    }
    scale_ = 1.5 * std::numbers::pi * found.material.adhesion * reduced_radius;
    if (!(scale_ > 0.0))
      for (const Place& p : places_) scale_ = std::max({scale_, std::abs(p.shells_out), std::abs(p.shells_in.value_or(0.0))});
  }

  [[nodiscard]] double scale() const { return scale_; }
  /// On the way in and then on the way out.
  [[nodiscard]] std::vector<double> wanted() const {
    std::vector<double> out;
    for (const Place& p : places_)
      if (p.shells_in) out.push_back(0.5 * (*p.shells_in + p.spheres));
    for (const Place& p : places_) out.push_back(0.5 * (p.shells_out + p.spheres));
    return out;
  }
  /// Likewise.
  [[nodiscard]] std::vector<double> forces(const Curves& pair) const {
    std::vector<double> out;
    for (const Place& p : places_)
      if (p.shells_in) out.push_back(pair.in.force(p.overlap));
    for (const Place& p : places_) out.push_back(pair.out.force(p.overlap));
    return out;
  }
  /// Means of both ways, where both touch.
  [[nodiscard]] std::vector<MixedComparison> against(const Curves& pair) const {
    std::vector<MixedComparison> out;
    for (const Place& p : places_) {
      MixedComparison& one = out.emplace_back(MixedComparison{p.overlap, p.shells_out, p.spheres, pair.out.force(p.overlap)});
      if (!p.shells_in) continue;
      one.shells = 0.5 * (one.shells + *p.shells_in);
      one.mixed = 0.5 * (one.mixed + pair.in.force(p.overlap));
    }
    return out;
  }

 private:
  struct Place {
    double overlap = 0.0, spheres = 0.0, shells_out = 0.0;
    std::optional<double> shells_in;  ///< none: they do not touch yet
  };
  std::vector<Place> places_;
  double scale_ = 0.0;
};

/// Mean square of a distance of each comparison [nN²].
template <class Distance>
double mean_square(const std::vector<MixedComparison>& all, const Distance& distance) {
  double sum = 0.0;
  for (const MixedComparison& one : all) sum += std::pow(distance(one), 2);
  return sum / static_cast<double>(std::max<std::size_t>(all.size(), 1));
}
double from_halfway(const MixedComparison& c) { return c.mixed - 0.5 * (c.shells + c.spheres); }
double beyond_both(const MixedComparison& c) {
  return std::max({0.0, std::min(c.shells, c.spheres) - c.mixed, c.mixed - std::max(c.shells, c.spheres)});
}

/// A trial of both factors, or a run that judges those that were found.
bool is_mixed(const Experiment& e, bool judges) { return e.kind == Experiment::Kind::kMixedPair && e.held_out == judges; }

/// What the root knows of mixed pairs, and what it makes of them.
class MixedPairs {
 public:
  MixedPairs(Calibration& found, int threads) : found_(found), threads_(threads) {}

  /// Fits both factors to the trials.
  Status fit() {
    std::vector<std::pair<cbm::WithShells, Curves>> trials;
    double deepest = 1e300;
    for (std::size_t e = 0; e < found_.experiments.size(); ++e) {
      const Experiment& trial = found_.experiments[e];
      if (!is_mixed(trial, false) || !found_.outcomes[e].done) continue;
      MORULA_TRY_ASSIGN(Curves curves, curves_of(trial, found_.outcomes[e]));
      deepest = std::min({deepest, curves.in.deepest(), curves.out.deepest()});
      trials.emplace_back(trial.with_shells, std::move(curves));
    }
    if (trials.empty()) return remark("no pair of a sphere and a shell was run: their contact follows the modulus of the sphere");
    const auto shells = shells_of(1.0);
    if (!shells)
      return remark("no pair of shells at the rate of the mixed pairs: contact of spheres with shells follows the modulus of the sphere");
    const Comparison compare(found_, *shells, 0.5 * found_.material.radius, deepest);
    calibrate::MixedData data{.wanted = compare.wanted(), .trials = {}, .scale = compare.scale()};
    for (const auto& [factors, curves] : trials) data.trials.push_back({factors.stiffness, factors.adhesion, compare.forces(curves)});
    if (has_clusters()) MORULA_TRY(add_promotions(data));
    const auto fitted = calibrate::fit_mixed(data);
    if (!fitted.ok()) return remark("contact of spheres with shells follows the modulus of the sphere: " + fitted.error().message);
    MixedContact& out = found_.with_shells.emplace();
    out.fit = *fitted;
    for (const auto& [factors, curves] : trials)
      if (factors.stiffness == 1.0 && factors.adhesion == 1.0)
        out.unfitted = std::sqrt(mean_square(compare.against(curves), from_halfway)) / compare.scale();
    if (out.fit.at_border)
      found_.data.remarks.emplace_back("a sphere with a shell: a factor is at the end of what was tried, the best one is beyond");
    return {};
  }

  /// How good they are, from runs with them.
  Status judge() {
    MixedContact& out = *found_.with_shells;
    double square = 0.0;
    int count = 0;
    for (std::size_t e = 0; e < found_.experiments.size(); ++e) {
      const Experiment& run = found_.experiments[e];
      if (!is_mixed(run, true)) continue;
      if (!found_.outcomes[e].done) {
        found_.data.remarks.push_back(run.name + " is missing: " + found_.outcomes[e].problem);
        continue;
      }
      MORULA_TRY_ASSIGN(const Curves curves, curves_of(run, found_.outcomes[e]));
      const bool equal = run.radius_a == run.radius_b;
      const auto shells = shells_of(equal ? 1.0 : kUnequalPair);
      if (!shells) continue;
      const double reduced = run.radius_a * run.radius_b / (run.radius_a + run.radius_b);
      const Comparison compare(found_, *shells, reduced, std::min(curves.in.deepest(), curves.out.deepest()));
      const auto all = compare.against(curves);
      if (equal) {
        out.misfit = std::sqrt(mean_square(all, from_halfway)) / compare.scale();
        out.outside = std::sqrt(mean_square(all, beyond_both)) / compare.scale();
        for (const MixedComparison& one : all) out.outside_worst = std::max(out.outside_worst, beyond_both(one) / compare.scale());
        out.comparisons = all;
      } else {
        square += mean_square(all, from_halfway) / (compare.scale() * compare.scale());
        ++count;
      }
    }
    if (count > 0) out.held_out = std::sqrt(square / count);
    if (has_clusters()) {
      MORULA_TRY_ASSIGN(out.promoted, way_with({out.fit.stiffness, out.fit.adhesion}));
    }
    return {};
  }

 private:
  /// Cells that adhere and have friction come to rest in clusters.
  [[nodiscard]] bool has_clusters() const { return !found_.data.clusters.empty(); }
  /// How far the neighbours of a sphere move when it becomes a shell, over R.
  [[nodiscard]] Result<double> way_with(const cbm::WithShells& factors) const {
    TrialLaw law = found_.spheres_to_take().law;
    law.sphere.with_shells = factors;
    return way_of_promotion(found_.material, law);
  }
  /// What each trial does where a sphere becomes a shell.
  Status add_promotions(calibrate::MixedData& data) const {
    std::vector<std::optional<Result<double>>> ways(data.trials.size());
    one_by_one(threads_, ways.size(), [&](std::size_t k) { ways[k] = way_with({data.trials[k].stiffness, data.trials[k].adhesion}); });
    data.way_scale = kWay;
    for (std::size_t k = 0; k < ways.size(); ++k) {
      MORULA_TRY_ASSIGN(data.trials[k].way, *ways[k]);
    }
    return {};
  }
  Status remark(std::string text) {
    found_.data.remarks.push_back(std::move(text));
    return {};
  }
  /// Two shells whose radii have this ratio, at the rate of mixed pairs.
  [[nodiscard]] std::optional<Curves> shells_of(double ratio) const {
    for (std::size_t e = 0; e < found_.experiments.size(); ++e) {
      const Experiment& pair = found_.experiments[e];
      if (pair.kind != Experiment::Kind::kPair || !found_.outcomes[e].done || pair.rate != mixed_pair_rate(found_.material) ||
          pair.radius_b != ratio * pair.radius_a)
        continue;
      auto curves = curves_of(pair, found_.outcomes[e]);
      if (curves.ok()) return std::move(curves).value();
    }
    return {};
  }

  Calibration& found_;
  int threads_;
};

/// Some numbers of the root on every rank; empty: it has none.
std::vector<double> from_root(const std::vector<double>& numbers, const Comm& comm) {
  std::vector<std::byte> bytes(comm.is_root() ? numbers.size() * sizeof(double) : 0);
  if (comm.is_root() && !numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  comm.broadcast(bytes);
  std::vector<double> out(bytes.size() / sizeof(double));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

/// Runs the trials, each with its own factors, or what judges those of the sphere.
Status run_mixed(Calibration& found, bool judges, cbm::SphereParameters sphere, const ExperimentRequest& request, const Comm& comm) {
  std::vector<Experiment> list;
  std::vector<std::size_t> place;
  for (std::size_t e = 0; e < found.experiments.size(); ++e) {
    Experiment& one = found.experiments[e];
    if (!is_mixed(one, judges)) continue;
    if (!judges) sphere.with_shells = one.with_shells;
    one.text = mixed_pair_experiment(found.material, one.name, one.radius_a, one.radius_b, sphere, one.seed).text;
    list.push_back(one), place.push_back(e);
  }
  MORULA_TRY_ASSIGN(const auto outcomes, run_experiments(list, request, comm));
  for (std::size_t k = 0; k < list.size(); ++k) found.outcomes[place[k]] = outcomes[k];
  return {};
}

}  // namespace

std::vector<Experiment> mixed_pairs(const CellMaterial& material) {
  std::vector<Experiment> out;
  const auto add = [&](const std::string& name, double sphere, double shell, const cbm::WithShells& factors, bool judges) {
    out.push_back(
        mixed_pair_experiment(material, name, sphere, shell, {.with_shells = factors}, static_cast<std::uint32_t>(out.size()) + 1));
    out.back().held_out = judges;
    out.back().text.clear();  // its sphere is not known yet
  };
  const double radius = material.radius, large = kUnequalPair * radius;
  for (const double stiffness : kStiffness)
    for (const double adhesion : kAdhesion)
      if (material.adhesion > 0.0 || adhesion == 1.0)
        add("mixed_pair_trial_" + std::to_string(out.size() + 1), radius, radius, {stiffness, adhesion}, false);
  add("mixed_pair", radius, radius, {}, true);
  add("mixed_pair_of_large_sphere", large, radius, {}, true);
  add("mixed_pair_of_large_shell", radius, large, {}, true);
  return out;
}

Status fit_with_shells(Calibration& found, const ExperimentRequest& request, const Comm& comm) {
  found.outcomes.resize(found.experiments.size());
  const calibrate::Fit& fit = found.sure.fit;
  const std::vector<double> body = from_root({fit.parameters.young, fit.poisson}, comm);
  cbm::SphereParameters sphere{.young = body[0], .poisson = body[1]};
  std::vector<double> numbers;
  for (const cbm::PackingKnot& knot : found.spheres_to_take().packing) numbers.insert(numbers.end(), {knot.packing, knot.pressure});
  numbers = from_root(numbers, comm);
  std::vector<cbm::PackingKnot> knots;
  for (std::size_t k = 0; k < numbers.size(); k += 2) knots.push_back({numbers[k], numbers[k + 1]});
  if (!knots.empty()) {
    MORULA_TRY_ASSIGN(sphere.packing, cbm::PackingCurve::through(knots));
  }
  MORULA_TRY(run_mixed(found, false, sphere, request, comm));
  MixedPairs pairs(found, request.threads);
  MORULA_TRY(agree(comm.is_root() ? pairs.fit() : Status{}, comm));
  std::vector<double> factors;
  if (found.with_shells) factors = {found.with_shells->fit.stiffness, found.with_shells->fit.adhesion};
  factors = from_root(factors, comm);
  if (factors.empty()) return {};
  sphere.with_shells = {factors[0], factors[1]};
  MORULA_TRY(run_mixed(found, true, sphere, request, comm));
  return agree(comm.is_root() ? pairs.judge() : Status{}, comm);
}

}  // namespace morula::scenarios
