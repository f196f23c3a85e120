#include "scenarios/library/criteria.h"

#include <algorithm>
#include <cmath>

#include "results/series_reader.h"
#include "scenarios/criteria/judge_criteria.h"
#include "scenarios/library/blastocyst.h"
#include "scenarios/library/embryo.h"
#include "scenarios/library/single_cell_studies.h"
#include "scenarios/measures/single_cell.h"
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

/// Those criteria of the study that its scenario judges.
std::vector<std::string> asked_of_scenario(const Study& study) {
  std::vector<std::string> out;
  for (const Criterion& criterion : study.criteria)
    if (criterion.is_of_scenario()) out.push_back(criterion.id.value);
  return out;
}

Status has_load(const Study& study, const std::shared_ptr<const morula::Load>& kind, const char* what) {
  for (const CellLoad& load : study.model.loads)
    if (load.what == kind) return {};
  return Error{ErrorKind::kInput, what, ""};
}

/// The criteria of the study's scenario; null where it has none.
const ScenarioCriteria* criteria_of(const Study& study) {
  for (const ScenarioCriteria& criteria : scenario_criteria())
    if (criteria.scenario == study.scenario) return &criteria;
  return nullptr;
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
  if (criteria_of(study) == nullptr && study.criteria.empty())
    out.push_back({"", "agreement with a theory, with data, or with what the study is meant to show",
                   "the study has no `criteria` and names no scenario that has; its parameters are as good as their sources (methods.md)"});
  return out;
}

}  // namespace

const std::vector<ScenarioCriteria>& scenario_criteria() {
  const auto grips = [](const Study& study) { return has_load(study, grip_load(), "a grip (`loads` with `grip`)"); };
  static const std::vector<ScenarioCriteria> all{
      {"blastocyst", &judge_blastocyst, &blastocyst_needs, {"S18.1", "S18.2", "S18.3", "S18.6"}},
      {"cell_shear", &judge_cell_shear, grips, {"SHEAR.0", "S4.6", "S6.5", "T9.6"}, &plot_cell_shear},
      {"embryo", &judge_embryo, &embryo_needs, {"S17.1", "S17.2", "S17.3", "S17.4", "S17.5", "S17.6"}, &plot_embryo},
      {"micropipette",
       &judge_micropipette,
       [](const Study& study) { return has_load(study, pressure_load(), "a suction (`loads` with `pressure`)"); },
       {"S3.0", "S3.1", "S3.2", "S3.3", "S3.4", "S3.5"},
       &plot_micropipette},
      {"optical_stretcher",
       &judge_optical_stretcher,
       [](const Study& study) { return has_load(study, traction_load(), "light that pulls (`loads` with `traction`)"); },
       {"S1.1", "S1.2", "S1.3", "S1.4", "S1.5", "S1.7", "S1.8"},
       &plot_optical_stretcher},
      {"optical_tweezers",
       &judge_optical_tweezers,
       [](const Study& study) { return has_load(study, pull_load(), "a pull at two poles (`loads` with `pull`)"); },
       {"S2.1", "S2.2", "S2.3", "S2.4", "S2.4b", "S2.5", "S2.6"},
       &plot_optical_tweezers},
      {"pull_off", &judge_pull_off, grips, {"S5.0", "S5.1", "S5.2", "S5.3", "S5.4", "S5.5", "S5.6", "S5.7", "T8.2"}, &plot_pull_off},
  };
  return all;
}

bool is_passive(const Study& study) {
  const Model& model = study.model;
  for (const CellType& type : model.types)
    if (type.fluctuations.energy > 0.0 || type.protrusion.force > 0.0 || !type.regional_tension.empty() || type.osmosis.acts() ||
        type.cycles || type.migration_speed > 0.0 || !type.behaviours.empty() || type.renew_mesh_below > 0.0)
      return false;
  for (const InitialCells& block : study.initial)
    if (block.start_volume_fraction < 1.0) return false;
  for (const ObstacleSpec& obstacle : model.obstacles)
    if (obstacle.moves()) return false;
  return model.loads.empty() && model.lumens.empty() && model.apical_springs.empty() && model.swaps.regions.empty() &&
         model.swaps.triggers.empty();
}

Status fits_scenario(const Study& study) {
  const ScenarioCriteria* const scenario = criteria_of(study);
  const std::vector<std::string> asked = asked_of_scenario(study);
  if (scenario == nullptr)
    return asked.empty() ? Status{}
                         : Status(Error{ErrorKind::kInput, "`criteria` has no effect: the study names no scenario that has criteria",
                                        "say what is measured (`measure`), or name the library study in `scenario`"});
  for (const std::string& id : asked)
    if (std::find(scenario->ids.begin(), scenario->ids.end(), id) == scenario->ids.end())
      return Error{ErrorKind::kInput, "'" + study.scenario + "' has no criterion '" + id + "'", suggest(id, scenario->ids)};
  if (scenario->needs == nullptr) return {};
  const Status needs = scenario->needs(study);
  if (needs.ok()) return {};
  return Error{ErrorKind::kInput, "the criteria of '" + study.scenario + "' need " + needs.error().message,
               "leave `scenario` away for studies of another kind"};
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
    Largest outside;
    for (const double value : clearance->values) outside.add(std::isnan(value) ? value : std::max(0.0, -value));
    out.verdicts.push_back(
        at_most("INV.5", "how far a node of a nucleus is outside its cortex, at any output", outside.value(), limits.overlap, "um"));
  }
  const char* rise = "rise of the energy between outputs, relative to its range";
  if (!is_passive(study))
    out.not_checked.push_back({"INV.7", rise, "something drives the tissue (growth, motion, loads, exchanges, renewed meshes): its energy may rise"});
  else if (series.rows() < 3)
    out.not_checked.push_back({"INV.7", rise, "the run has fewer than two outputs after its start"});
  else
    out.verdicts.push_back(at_most("INV.7", rise, largest_rise(series.find("energy")), kEnergyRise));
  if (!study.model.fields.empty())
    out.verdicts.push_back(at_most("LIMIT.field_balance", "balance of the amounts of every field, relative",
                                   largest(series.find("field_balance")), limits.field_balance));
  return out;
}

Result<Judgement> judge(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(Judgement out, common_criteria(study, run));
  FinishedRun finished(study, run);
  MORULA_TRY_ASSIGN(std::vector<Verdict> own, judge_criteria(finished));
  std::move(own.begin(), own.end(), std::back_inserter(out.verdicts));
  const ScenarioCriteria* const scenario = criteria_of(study);
  if (scenario == nullptr) return out;
  std::vector<Verdict> found;
  if (const Status fits = fits_scenario(study); fits.ok()) {
    MORULA_TRY_ASSIGN(found, scenario->judge(study, run));
  } else {
    found.push_back({"SCENARIO", fits.error().message, kNothing, "what it needs", false});
  }
  const auto is_judged = [&](const std::string& id) {
    return std::any_of(found.begin(), found.end(), [&](const Verdict& v) { return v.id == id; });
  };
  const std::vector<std::string> asked = asked_of_scenario(study);
  for (const std::string& id : asked)
    if (!is_judged(id))
      out.verdicts.push_back({id, "named by the study, and nothing in its results to judge it on", kNothing, "judged", false});
  if (found.empty() && asked.empty() && own.empty())
    out.verdicts.push_back({"SCENARIO", "criteria of '" + study.scenario + "' that could be judged", 0.0, ">= 1", false});
  for (const std::string& id : scenario->ids)
    if (!is_judged(id) && std::find(asked.begin(), asked.end(), id) == asked.end())
      out.not_checked.push_back({id, "criterion of '" + study.scenario + "'", "another version of the study, or other settings, show it"});
  out.verdicts.insert(out.verdicts.end(), found.begin(), found.end());
  return out;
}

Result<std::vector<NamedPlot>> scenario_plots(const Study& study, const std::filesystem::path& run) {
  FinishedRun finished(study, run);
  MORULA_TRY_ASSIGN(std::vector<NamedPlot> out, study_plots(finished));
  const ScenarioCriteria* const scenario = criteria_of(study);
  if (scenario == nullptr || scenario->plots == nullptr || !fits_scenario(study).ok()) return out;
  MORULA_TRY_ASSIGN(std::vector<NamedPlot> more, scenario->plots(study, run));
  std::move(more.begin(), more.end(), std::back_inserter(out));
  return out;
}

}  // namespace morula::scenarios
