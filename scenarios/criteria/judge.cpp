#include "scenarios/criteria/judge.h"

#include <algorithm>
#include <cmath>

#include "coupling/changing_box.h"
#include "results/series_reader.h"
#include "scenarios/criteria/judge_criteria.h"
#include "scenarios/measures/verdicts.h"

namespace morula::scenarios {
namespace {

constexpr double kEnergyRise = 1e-3;  // of the range (INV.7)
constexpr double kRest = 1e-9;        // range of the energy over its size, below which a tissue is at rest and what is left is rounding

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

/// What no row of a series shows, for any run.
std::vector<NotChecked> never_checked(const Study& study) {
  const char* tests = "held by the tests of the program, not looked at in a run";
  std::vector<NotChecked> out{{"INV.1", "forces between cells and within them add up to nothing", tests},
                              {"INV.2", "surfaces stay closed, with well-shaped faces", tests},
                              {"INV.6", "residual of the linear systems", tests},
                              {"INV.8, INV.9", "the same bits on any number of threads and ranks, and over a restart", tests},
                              {"", "errors of step, mesh and tolerance",
                               "run the study again with half the step, with a finer mesh, with other seeds: docs/convergence.md"}};
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
  MORULA_TRY_ASSIGN(const SeriesTable series, read_series(run / "series.csv"));
  const Limits& limits = study.model.limits;
  Judgement out;
  out.not_checked = never_checked(study);
  out.verdicts.push_back(
      at_most("INV.3", "volume of any cell against its pressure law, relative", largest(series.find("volume_error")), limits.volume_error));
  const char* penetration = "deepest penetration of a surface at the start and in any step";
  if (largest(series.find("shell_count")) == 0.0)
    out.not_checked.push_back({"INV.4", penetration, "no cell was a shell at any output: spheres of a pair law overlap"});
  else
    out.verdicts.push_back(at_most("INV.4", penetration, largest(series.find("worst_overlap")), limits.overlap, "um"));
  if (const auto* clearance = series.find("nucleus_clearance")) {
    const char* quantity = "how far a node of a nucleus is outside its cortex, at any output";
    Largest outside;
    for (const double value : clearance->values)
      if (!std::isnan(value)) outside.add(std::max(0.0, -value));
    if (outside.shown())
      out.verdicts.push_back(at_most("INV.5", quantity, outside.value(), limits.overlap, "um"));
    else
      out.not_checked.push_back({"INV.5", quantity, "no cell had a nucleus at any output"});
  }
  if (std::any_of(study.model.types.begin(), study.model.types.end(),
                  [](const CellType& type) { return type.interior.has_rigid_nucleus(); }))
    out.not_checked.push_back({"INV.5", "how far rigid nuclei are outside their cortex", "only of nuclei that are shells it is measured"});
  const char* rise = "rise of the energy between outputs, relative to its range";
  if (!is_passive(study))
    out.not_checked.push_back(
        {"INV.7", rise,
         "something drives the tissue (growth, motion, loads, a box that changes, exchanges, renewed meshes): its energy may rise"});
  else if (series.rows() < 3)
    out.not_checked.push_back({"INV.7", rise, "the run has fewer than two outputs after its start"});
  else
    out.verdicts.push_back(at_most("INV.7", rise, largest_rise(series.find("energy")), kEnergyRise));
  if (!study.model.fields.empty())
    out.verdicts.push_back(at_most("LIMIT.field_balance", "balance of the amounts of every field, relative",
                                   largest(series.find("field_balance")), limits.field_balance));
  if (!study.model.fields.empty() && !periodic_along_all_axes(study.model.space))
    out.verdicts.push_back(at_most("LIMIT.outside_fields", "cells beyond the faces of the domain, where no field is",
                                   largest(series.find("outside_fields")), 0.0));
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

}  // namespace morula::scenarios
