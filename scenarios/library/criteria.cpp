#include "scenarios/library/criteria.h"

#include <algorithm>
#include <cmath>

#include "scenarios/library/blastocyst.h"
#include "scenarios/library/cavity.h"
#include "scenarios/library/embryo.h"
#include "scenarios/library/hybrid_spheroid.h"
#include "scenarios/library/single_cell.h"
#include "scenarios/library/verdicts.h"
#include "scenarios/report/series_reader.h"

namespace morula::scenarios {
namespace {

constexpr double kEnergyRise = 1e-3;  // of the range (INV.7)
constexpr double kRest = 1e-9;        // range of the energy over its size, below which a tissue is at rest and what is left is rounding

/// Largest value of a column; NaN (which passes no limit) where a value is no number.
double largest(const SeriesColumn& column) {
  double out = 0.0;
  for (const double value : column.values)
    if (!(value <= out)) out = value;
  return out;
}

/// Largest rise between two rows, relative to the range. The row of time 0 has no step before it and is left out.
double largest_rise(const SeriesColumn& energy) {
  double rise = 0.0, low = 1e300, high = -1e300;
  for (std::size_t i = 1; i < energy.values.size(); ++i) {
    low = std::min(low, energy.values[i]);
    high = std::max(high, energy.values[i]);
    if (i > 1) rise = std::max(rise, energy.values[i] - energy.values[i - 1]);
  }
  return high > low ? rise / std::max(high - low, kRest * std::max(std::abs(low), std::abs(high))) : 0.0;
}

}  // namespace

const std::vector<ScenarioCriteria>& scenario_criteria() {
  static const std::vector<ScenarioCriteria> all{
      {"blastocyst", &judge_blastocyst},
      {"cavity", &judge_cavity},
      {"cell_shear", &judge_cell_shear, &plot_cell_shear},
      {"doublet", &judge_doublet, &plot_doublet},
      {"embryo", &judge_embryo, &plot_embryo},
      {"hybrid_spheroid", &judge_hybrid_spheroid},
      {"micropipette", &judge_micropipette, &plot_micropipette},
      {"optical_stretcher", &judge_optical_stretcher, &plot_optical_stretcher},
      {"optical_tweezers", &judge_optical_tweezers, &plot_optical_tweezers},
      {"parallel_plates", &judge_parallel_plates, &plot_parallel_plates},
      {"pull_off", &judge_pull_off, &plot_pull_off},
      {"spreading", &judge_spreading, &plot_spreading},
  };
  return all;
}

bool is_passive(const Study& study) {
  const Model& model = study.model;
  for (const CellType& type : model.types)
    if (type.fluctuations.energy > 0.0 || type.protrusion.force > 0.0 || !type.regional_tension.empty() || type.osmosis.acts() ||
        type.cycles || type.migration_speed > 0.0 || (type.death_field >= 0 && type.death_rate > 0.0))
      return false;
  for (const InitialCells& block : study.initial)
    if (block.start_volume_fraction < 1.0) return false;
  for (const ObstacleSpec& obstacle : model.obstacles)
    if (obstacle.moves()) return false;
  return model.loads.empty() && model.lumens.empty() && model.apical_springs.empty() && model.swaps.regions.empty() &&
         model.swaps.triggers.empty();
}

Result<std::vector<Verdict>> common_criteria(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const SeriesTable series, read_series(run / "series.csv"));
  const Limits& limits = study.model.limits;
  std::vector<Verdict> out;
  if (const auto* error = series.find("volume_error"))
    out.push_back(at_most("INV.3", "volume of any cell against its pressure law, relative", largest(*error), limits.volume_error));
  if (const auto* overlap = series.find("worst_overlap"))
    out.push_back(
        at_most("INV.4", "deepest penetration of a surface at the start and in any step", largest(*overlap), limits.overlap, "um"));
  if (const auto* clearance = series.find("nucleus_clearance")) {
    double outside = 0.0;  // a value that is no number passes no limit
    for (const double value : clearance->values)
      if (!(-value <= outside)) outside = -value;
    out.push_back(at_most("INV.5", "how far a node of a nucleus is outside its cortex, at any output", outside, limits.overlap, "um"));
  }
  if (const auto* energy = series.find("energy"); energy && is_passive(study) && energy->values.size() > 2)
    out.push_back(at_most("INV.7", "rise of the energy between outputs, relative to its range", largest_rise(*energy), kEnergyRise));
  if (const auto* balance = series.find("field_balance"))
    out.push_back(
        at_most("LIMIT.field_balance", "balance of the amounts of every field, relative", largest(*balance), limits.field_balance));
  return out;
}

Result<std::vector<Verdict>> judge(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(std::vector<Verdict> out, common_criteria(study, run));
  for (const ScenarioCriteria& criteria : scenario_criteria()) {
    if (criteria.scenario != study.scenario) continue;
    MORULA_TRY_ASSIGN(const std::vector<Verdict> more, criteria.judge(study, run));
    out.insert(out.end(), more.begin(), more.end());
  }
  return out;
}

Result<std::vector<NamedPlot>> scenario_plots(const Study& study, const std::filesystem::path& run) {
  for (const ScenarioCriteria& criteria : scenario_criteria())
    if (criteria.scenario == study.scenario && criteria.plots != nullptr) return criteria.plots(study, run);
  return std::vector<NamedPlot>{};
}

}  // namespace morula::scenarios
