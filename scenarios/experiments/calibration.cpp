#include "scenarios/experiments/calibration.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "core/numbers/joined.h"
#include "core/numbers/number_text.h"
#include "results/file_io.h"
#include "scenarios/experiments/budget.h"
#include "scenarios/experiments/pressed_spheres.h"
#include "scenarios/experiments/spheres_in_packings.h"

namespace morula::scenarios {
namespace {

cbm::PackingCurve curve_of(std::span<const cbm::PackingKnot> knots) {
  auto made = cbm::PackingCurve::through(knots);
  return made.ok() ? std::move(made).value() : cbm::PackingCurve();
}

/// What people must know before they trust the numbers: forces that never push, JKR far outside of its range.
void remark_on_range(Calibration& out) {
  const auto pushes = [](const calibrate::PairPoint& point) { return !point.held_out && point.force > 0.0; };
  if (std::ranges::none_of(out.data.points.pairs, pushes))
    out.data.remarks.emplace_back("no pair pushes at any overlap that was reached: its distance at rest is not known");
  if (out.jkr_is_beyond_range())
    out.data.remarks.push_back("JKR with these numbers is beyond its range: at rest its contact radius is " +
                               number_text("%.2g", out.rest_of_jkr()) + " R, and 0.4 R is what it asks for");
}

/// What only the root does, once all runs are there: the fit of JKR, and of a table.
class Fitting {
 public:
  Fitting(const Study& study, const SpheresInPackings& places, const PressedSpheres& clusters, Calibration& out)
      : out_(out), places_(places), clusters_(clusters), points_(out.data.points) {
    options_.poisson = std::ranges::find(study.model.types, out.material.type, &CellType::name)->sphere.poisson;
    options_.seed = study.model.seed;
  }

  Status jkr() {
    calibrate::Data& points = out_.data.points;
    const auto make = [&](const calibrate::Data& now) -> Result<TrialLaw> {
      MORULA_TRY_ASSIGN(const calibrate::Fit fit, calibrate::fit(now, options_));
      return trial(fit);
    };
    MORULA_TRY(rest_in_packings(points, make));
    MORULA_TRY_ASSIGN(out_.sure, calibrate::fit_with_confidence(points, options_));
    out_.misfit = calibrate::misfit_share(points, out_.sure.fit);
    remark_on_range(out_);
    MORULA_TRY_ASSIGN(out_.jkr, spheres_of(trial(out_.sure.fit), out_.sure.fit.parameters.knots, "JKR", points));
    return {};
  }

  Status table() {
    std::optional<FittedTable> one;
    const auto make = [&](const calibrate::Data& now) -> Result<TrialLaw> {
      MORULA_TRY_ASSIGN(one, table_with_packing(now));
      return trial(*one);
    };
    if (const auto found = calibrate::fit_table(points_); !found.ok()) {
      out_.data.remarks.push_back("no table: " + found.error().message);
      return {};
    }
    MORULA_TRY(rest_in_packings(points_, make));
    MORULA_TRY_ASSIGN(const TrialLaw law, make(points_));
    one->exponent = calibrate::force_exponent(points_, one->table);
    MORULA_TRY_ASSIGN(one->spheres, spheres_of(law, one->spheres.packing, "the table", points_));
    out_.table = std::move(one);
    return {};
  }

 private:
  /// A table and the curve of packing that it leaves to packings. The table is what two cells do less what the curve adds to them, and so both are found in turns.
  [[nodiscard]] Result<FittedTable> table_with_packing(const calibrate::Data& points) const {
    constexpr int kTurns = 4;  // the curve acts on pairs that are pressed deeper than those of most packings
    FittedTable out;
    for (int turn = 1;; ++turn) {
      MORULA_TRY_ASSIGN(out.table, calibrate::fit_table(points, curve_of(out.spheres.packing)));
      if (turn == kTurns) return out;
      out.spheres.packing = calibrate::fit_curve(points, calibrate::table_model(out.table), options_);
    }
  }
  /// Gives the spheres of the random packings the places in which laws that `make` fits to them let them rest, with the friction that such spheres have. That along
  /// their contacts is not known before there is a law: at first that of approach stands for it (decision 0073).
  template <class Make>
  Status rest_in_packings(calibrate::Data& points, const Make& make) {
    along_.reset();
    const auto resting = [&](const calibrate::Data& now) -> Result<TrialLaw> {
      MORULA_TRY_ASSIGN(TrialLaw law, make(now));
      return with_friction(std::move(law));
    };
    MORULA_TRY(fit_in_turns(points, options_.weights, resting, places_));
    if (points.packings.empty() || out_.data.pressed.empty()) return {};
    MORULA_TRY_ASSIGN(const TrialLaw first, resting(points));
    const auto along = along_of(first);
    if (!along.ok()) return {};
    along_ = along->factor;
    return fit_in_turns(points, options_.weights, resting, places_);
  }
  /// What is found for spheres of any law: they come to rest in the packings that were held out, where `points` then has them.
  Result<SpheresOfLaw> spheres_of(const TrialLaw& law, std::vector<cbm::PackingKnot> packing, const char* name, calibrate::Data& points) {
    SpheresOfLaw out;
    out.packing = std::move(packing);
    out.law = with_friction(law);
    MORULA_TRY(places_.place(out.law, true, points));
    MORULA_TRY_ASSIGN(out.crowding, crowding_of(law, points));
    out.held_out = calibrate::held_out_errors(points, law.pair, law.sphere.packing, out_.sure.fit.pull_off(1.0));
    out.friction = friction_of(law, name);
    MORULA_TRY_ASSIGN(out.clusters, spheres_in_clusters(out_.material, out_.data.clusters, out.law));
    return out;
  }
  /// Contact areas of spheres of the law where they come to rest in the packings; those that were held out are there already.
  Result<calibrate::FittedCrowding> crowding_of(const TrialLaw& law, calibrate::Data points) const {
    MORULA_TRY(places_.place(with_friction(law), false, points));
    return calibrate::fit_crowded_area(points.packings, calibrate::resting_share(law.of_two(), out_.material.radius));
  }
  /// Nothing of what cannot be told, and a remark why.
  FrictionOfSpheres friction_of(const TrialLaw& law, const char* name) {
    FrictionOfSpheres out;
    const ExperimentData& data = out_.data;
    const auto take = [&](const char* what, const auto& found, auto& to) {
      if (found.ok())
        to = *found;
      else
        out_.data.remarks.push_back(std::string(what) + " for " + name + ": " + found.error().message);
    };
    if (!data.relaxations.empty())
      take("no friction of approach", calibrate::fit_approach_friction(data.relaxations, law.of_two()), out.approach);
    if (!data.pressed.empty()) take("no friction along the contact", along_of(with_friction(law)), out.along);
    constexpr double kHardlyTold = 100.0;  // of an interval, its end over its begin
    if (out.along && out.along->high > kHardlyTold * out.along->low)
      out_.data.remarks.push_back("friction along the contact for " + std::string(name) +
                                  " is hardly told by pressed clusters: anything from " + number_text("%.2g", out.along->low) + " to " +
                                  number_text("%.2g nN s/um^3", out.along->high));
    constexpr double kWrongLaw = 0.1;  // of the work
    if (out.along && out.along->misfit > kWrongLaw)
      out_.data.remarks.push_back(
          "balls of spheres of " + std::string(name) + ", pressed flat with the friction that was found, differ by " +
          number_text("%.0f %%", 100.0 * out.along->misfit) + " of the work from balls of shells: that is their law, not their friction");
    return out;
  }
  /// With which spheres of a law that has its friction of approach are pressed flat as shells are.
  [[nodiscard]] Result<calibrate::FittedAlong> along_of(const TrialLaw& law) const {
    const auto spheres = [&](std::span<const double> factors) { return clusters_.press(law, factors); };
    return calibrate::fit_friction_along(out_.data.pressed, out_.material.friction.along, law.sphere.approach_factor, spheres);
  }
  /// Gives spheres of the law the friction of approach that their pairs tell, and along their contacts that which was found, or else the same.
  [[nodiscard]] TrialLaw with_friction(TrialLaw law) const {
    if (!out_.data.relaxations.empty())
      if (const auto found = calibrate::fit_approach_friction(out_.data.relaxations, law.of_two()); found.ok())
        law.sphere.approach_factor = found->factor;
    law.sphere.along_factor = along_.value_or(law.sphere.approach_factor);
    return law;
  }
  [[nodiscard]] TrialLaw trial(const calibrate::Fit& fit) const {
    TrialLaw out{.sphere = {},
                 .adhesion = fit.parameters.adhesion,
                 .pair = calibrate::jkr_model(fit.parameters.young, fit.poisson, fit.parameters.adhesion)};
    out.sphere.young = fit.parameters.young, out.sphere.poisson = fit.poisson;
    out.sphere.packing = curve_of(fit.parameters.knots);
    return out;
  }
  [[nodiscard]] TrialLaw trial(const FittedTable& fitted) const {
    TrialLaw out = trial(out_.sure.fit);
    out.pair = calibrate::table_model(fitted.table);
    out.sphere.law = cbm::table_law(fitted.table);
    out.sphere.packing = curve_of(fitted.spheres.packing);
    return out;
  }

  Calibration& out_;
  const SpheresInPackings& places_;
  const PressedSpheres& clusters_;
  calibrate::Data points_;  // for the table, whose spheres lie elsewhere
  calibrate::FitOptions options_;
  std::optional<double>
      along_;  ///< friction along contacts with which spheres come to rest in packings, over that of the study; none: not found yet
};

Status fit_on_root(const Study& study, int threads, Calibration& out) {
  MORULA_TRY_ASSIGN(out.data, data_of_runs(out.experiments, out.outcomes));
  if (!out.left_out.empty())
    out.data.remarks.push_back("no time for " + joined(out.left_out) +
                               ": what they would have told is not fitted, intervals are wider, or nothing judges the fit");
  MORULA_TRY_ASSIGN(const auto places, SpheresInPackings::read(out.material, out.data.packings, threads));
  MORULA_TRY_ASSIGN(const auto clusters, PressedSpheres::read(out.material, out.data.pressed_seeds, threads));
  Fitting fitting(study, places, clusters, out);
  MORULA_TRY(fitting.jkr());
  return fitting.table();
}

}  // namespace

double Calibration::rest_of_jkr() const {
  const cbm::SphereParameters sphere{.young = sure.fit.parameters.young, .poisson = sure.fit.poisson};
  return cbm::resting_contact(sphere, material.radius, sphere, material.radius, sure.fit.parameters.adhesion).radius_ratio;
}

Result<Calibration> calibrate_jkr(const Study& study, const std::string& type, const ExperimentRequest& request, const Comm& comm) {
  Calibration out;
  MORULA_TRY_ASSIGN(out.material, material_of(study, type));
  out.experiments = experiments_for(out.material, request.packings);
  if (request.budget) {
    MORULA_TRY_ASSIGN(Shortened list, within_budget(std::move(out.experiments), out.material.nodes, *request.budget));
    out.experiments = std::move(list.kept);
    out.left_out = std::move(list.left_out);
    if (comm.is_root() && request.on_note)
      request.on_note(number_text("%.0f", list.seconds) + " s of one core expected" +
                      (out.left_out.empty() ? "" : "; no time for " + joined(out.left_out)));
  }
  const auto mixed = std::ranges::find(out.experiments, Experiment::Kind::kMixedPair, &Experiment::kind);
  const auto shells_only = std::span(out.experiments).first(static_cast<std::size_t>(mixed - out.experiments.begin()));
  MORULA_TRY_ASSIGN(out.outcomes, run_experiments(shells_only, request, comm));
  MORULA_TRY(agree(comm.is_root() ? fit_on_root(study, request.threads, out) : Status{}, comm));
  MORULA_TRY(fit_with_shells(out, request, comm));
  return out;
}

}  // namespace morula::scenarios
