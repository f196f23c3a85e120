#include "scenarios/criteria/judge.h"

#include <algorithm>
#include <cmath>

#include "coupling/changing_box.h"
#include "results/run_files.h"
#include "results/series_reader.h"
#include "scenarios/criteria/judge_criteria.h"
#include "scenarios/criteria/run_checks.h"
#include "scenarios/measures/verdicts.h"

namespace morula::scenarios {
namespace {

/// Range of the energy over its size, below which a tissue is at rest and what is left are the tolerances of the steps: of the energy of a few cells, 1e-7 of it
/// (what the limit leaves of that) are a few kT.
constexpr double kRest = 1e-4;

/// Largest value of a column; kNothing, which passes no limit, without a row or where a value is no number.
double largest(const SeriesColumn* column) {
  Largest out;
  for (std::size_t i = 0; column != nullptr && i < column->values.size(); ++i) out.add(column->values[i]);
  return out.value();
}

/// Largest rise between two rows, relative to the range. The row of time 0 has no step before it and is left out; kNothing without two
/// others.
double largest_rise(const SeriesColumn* energy) {
  Largest rise, high, minus_low;
  for (std::size_t i = 1; energy != nullptr && i < energy->values.size(); ++i) {
    high.add(energy->values[i]);
    minus_low.add(-energy->values[i]);
    if (i > 1) rise.add(std::max(0.0, energy->values[i] - energy->values[i - 1]));
  }
  const double range = high.value() + minus_low.value();
  const double size = std::max(std::abs(high.value()), std::abs(minus_low.value()));
  return range == 0.0 ? rise.value() : rise.value() / std::max(range, kRest * size);
}

NotChecked not_checked(const char* id, std::string why) { return {id, run_check(id).quantity, std::move(why)}; }

Verdict at_most_of(const char* id, double value, double limit, const char* unit = "") {
  return at_most(id, run_check(id).quantity, value, limit, unit);
}

/// What no row of a series shows, for any run.
std::vector<NotChecked> never_checked(const Study& study) {
  std::vector<NotChecked> out;
  for (const char* id : {"INV.1", "INV.2", "INV.6", "INV.8", "INV.9"})
    out.push_back(not_checked(id, "held by the tests of the program, not looked at in a run"));
  out.push_back({"", "errors of step, mesh and tolerance",
                 "run the study again with half the step, with a finer mesh, with other seeds: docs/convergence.md"});
  if (study.criteria.empty())
    out.push_back({"", "agreement with a theory, with data, or with what the study is meant to show",
                   "the study has no `criteria`; its parameters are as good as their sources (methods.md)"});
  return out;
}

}  // namespace

bool is_passive(const Study& study) {
  const Model& model = study.model;
  for (const CellType& type : model.types)
    if (type.fluctuations.energy > 0.0 || type.protrusion.force > 0.0 || !type.regional_tension.empty() || type.osmosis.acts() ||
        type.cycles || type.migration.acts() || !type.behaviours.empty() || type.renew_mesh_below > 0.0)
      return false;
  for (const InitialCells& block : study.initial)
    if (block.start_volume_fraction < 1.0) return false;
  for (const ObstacleSpec& obstacle : model.obstacles)
    if (obstacle.moves()) return false;
  return model.box_volume.empty() && model.loads.empty() && model.lumens.empty() && model.apical_springs.empty() && !model.swaps.any();
}

Result<Judgement> common_criteria(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const SeriesTable series, read_series(RunFiles(run).series()));
  const Limits& limits = study.model.limits;
  Judgement out;
  out.not_checked = never_checked(study);
  out.verdicts.push_back(at_most_of("INV.3", largest(series.find("volume_error")), limits.volume_error));
  if (largest(series.find("shell_count")) == 0.0)
    out.not_checked.push_back(not_checked("INV.4", "no cell was a shell at any output: spheres of a pair law overlap"));
  else
    out.verdicts.push_back(at_most_of("INV.4", largest(series.find("worst_overlap")), limits.overlap, "um"));
  if (const auto* clearance = series.find("nucleus_clearance")) {
    Largest outside;
    for (const double value : clearance->values)
      if (!std::isnan(value)) outside.add(std::max(0.0, -value));
    if (outside.shown())
      out.verdicts.push_back(at_most_of("INV.5", outside.value(), limits.overlap, "um"));
    else
      out.not_checked.push_back(not_checked("INV.5", "no cell had a nucleus at any output"));
  }
  if (std::ranges::any_of(study.model.types, [](const CellType& type) { return type.interior.has_rigid_nucleus(); }))
    out.not_checked.push_back({"INV.5", "how far rigid nuclei are outside their cortex", "only of nuclei that are shells it is measured"});
  if (!is_passive(study))
    out.not_checked.push_back(not_checked(
        "INV.7",
        "something drives the tissue (growth, motion, loads, a box that changes, exchanges, renewed meshes): its energy may rise"));
  else if (series.rows() < 3)
    out.not_checked.push_back(not_checked("INV.7", "the run has fewer than two outputs after its start"));
  else
    out.verdicts.push_back(at_most_of("INV.7", largest_rise(series.find("energy")), kMostEnergyRise));
  if (study.model.fields.empty()) return out;
  out.verdicts.push_back(at_most_of("LIMIT.field_balance", largest(series.find("field_balance")), limits.field_balance));
  if (!periodic_along_all_axes(study.model.space))
    out.verdicts.push_back(at_most_of("LIMIT.outside_fields", largest(series.find("outside_fields")), 0.0));
  return out;
}

Result<Judgement> judge(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(Judgement out, common_criteria(study, run));
  FinishedRun finished(study, run);
  MORULA_TRY_ASSIGN(std::vector<Verdict> own, judge_criteria(finished));
  std::move(own.begin(), own.end(), std::back_inserter(out.verdicts));
  return out;
}

Result<std::vector<NamedPlot>> declared_plots(const Study& study, const std::filesystem::path& run) {
  FinishedRun finished(study, run);
  return study_plots(finished);
}

Result<std::vector<NamedPlot>> plots_of(const Study& study, const std::filesystem::path& run, const SeriesTable& series) {
  MORULA_TRY_ASSIGN(std::vector<NamedPlot> out, declared_plots(study, run));
  const std::size_t declared = out.size();
  for (NamedPlot& plot : standard_plots(study, series))
    if (std::none_of(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(declared),
                     [&](const NamedPlot& own) { return own.name == plot.name; }))
      out.push_back(std::move(plot));
  return out;
}

}  // namespace morula::scenarios
