#include "scenarios/experiments/calibration.h"

#include <algorithm>
#include <span>
#include <utility>

#include "core/numbers/number_text.h"
#include "results/file_io.h"

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

/// What only the root does, once all runs are there.
Status fit_on_root(const Study& study, Calibration& out) {
  MORULA_TRY_ASSIGN(out.data, data_of_runs(out.experiments, out.outcomes));
  const auto type = std::ranges::find(study.model.types, out.material.type, &CellType::name);
  calibrate::FitOptions options;
  options.poisson = type->sphere.poisson;
  options.seed = study.model.seed;
  MORULA_TRY_ASSIGN(out.sure, calibrate::fit_with_confidence(out.data.points, options));
  const calibrate::Fit& fit = out.sure.fit;
  const double pull_off = fit.pull_off(1.0);
  out.misfit = calibrate::misfit_share(out.data.points, fit);
  out.held_out =
      calibrate::held_out_errors(out.data.points, calibrate::jkr_model(fit.parameters.young, fit.poisson, fit.parameters.adhesion),
                                 curve_of(fit.parameters.knots), pull_off);
  remark_on_range(out);
  auto table = calibrate::fit_table(out.data.points);
  if (!table.ok()) {
    out.data.remarks.push_back("no table: " + table.error().message);
    return {};
  }
  FittedTable one{.table = std::move(table).value(), .packing = {}, .held_out = {}, .exponent = {}};
  const calibrate::PairModel model = calibrate::table_model(one.table);
  if (!out.data.points.packings.empty()) one.packing = calibrate::fit_curve(out.data.points, model, options);
  one.held_out = calibrate::held_out_errors(out.data.points, model, curve_of(one.packing), pull_off);
  one.exponent = calibrate::force_exponent(out.data.points, one.table);
  out.table = std::move(one);
  return {};
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
  MORULA_TRY_ASSIGN(out.outcomes, run_experiments(out.experiments, request, comm));
  MORULA_TRY(agree(comm.is_root() ? fit_on_root(study, out) : Status{}, comm));
  return out;
}

}  // namespace morula::scenarios
