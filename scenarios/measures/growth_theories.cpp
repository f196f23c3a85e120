// How tissues grow.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/behaviours/balanced_growth.h"
#include "scenarios/measures/theories.h"

namespace morula::scenarios {
namespace {

/// The one cell type that divides, as far as `measure` is concerned: all types, or the type of `count_<type>`. −1: none, or several.
int dividing_type(const Model& model, const std::string& measure) {
  int found = -1;
  for (std::size_t t = 0; t < model.types.size(); ++t) {
    if (measure.starts_with("count_") && measure != "count_" + model.types[t].name) continue;
    if (!model.types[t].cycles || found >= 0) return -1;
    found = static_cast<int>(t);
  }
  return found;
}

/// What keeps cells of a type from dividing once in every mean duration, as far as the study says it; null: nothing. (That neighbours press is told by the run.)
const char* what_keeps_from_dividing(const CellType& type, std::uint16_t own) {
  if (std::ranges::any_of(type.behaviours, [](const CellBehaviour& one) { return one.what == starvation() && one.may_act(); }))
    return "cells that do not die: leave `death` away";
  if (!type.cycle.arrest.empty() || std::ranges::any_of(type.cycle.phases, [](const CyclePhase& phase) { return !phase.arrest.empty(); }))
    return "cells that nothing holds back: leave `arrest` away";
  if (std::ranges::any_of(type.fates.all, [own](const Fate& fate) { return fate.share > 0.0 && fate.type != std::array{own, own}; }))
    return "cells whose daughters divide as they do: leave `fates` away";
  return nullptr;
}

}  // namespace

Theory exponential_growth() {
  return {"exponential_growth",
          "exponential growth",
          "Cells that all divide once in every mean duration D of their cycle, from what there was at time 0; without death and "
          "inhibition. With "
          "phases at the rate that follows from the times of all of them.",
          "N(t) = N(0) 2^(t/D), with a spread c of D 2^((1 + c² ln 2/2) t/D); with phases N(0) e^(αt), Π E[e^(−αT)] = ½",
          "Malthus 1798; physics/cbm.md §5",
          {"cell_count", "total_volume", "count_"},
          [](const Study& study, const Subject&, const std::string& measure) -> Status {
            const int type = dividing_type(study.model, measure);
            if (type < 0) return Error{ErrorKind::kInput, "needs cells of one type, with a cycle", ""};
            const CellType& dividing = study.model.types[static_cast<std::size_t>(type)];
            if (dividing.cycle_duration.relative_spread > 0.0 && dividing.cycle_duration.correlation != 0.0)
              return Error{ErrorKind::kInput,
                           "needs cells that do not take after their mothers: `correlation` makes families of fast cells", ""};
            if (dividing.cycle.phases.empty() && dividing.cycle.control != SizeControl::kTimer)
              return Error{ErrorKind::kInput, "needs a cycle of times: where size is controlled, the sizes at the start decide", ""};
            if (const char* const needs = what_keeps_from_dividing(dividing, static_cast<std::uint16_t>(type)))
              return Error{ErrorKind::kInput, std::string("needs ") + needs, ""};
            if (measure == "total_volume" && (!dividing.cycle.growth->grows || dividing.cycle.ratio != 2.0))
              return Error{ErrorKind::kInput, "knows the volume of cells that double it from division to division only",
                           "`ratio: 2`, and a law of growth"};
            return Status{};
          },
          [](FinishedRun& run, const Subject&, const std::string& measure, const Sample& sample) -> Result<double> {
            MORULA_TRY_ASSIGN(const SeriesTable* const series, run.series());
            const int type = dividing_type(run.study().model, measure);
            const SeriesColumn* const column = series->find(measure);
            const SeriesColumn* const time = series->find("time");
            const bool from_start = time != nullptr && !time->values.empty() && time->values.front() == 0.0;  // N(0) is there
            if (type < 0 || column == nullptr || !from_start) return std::nan("");
            const CellType& dividing = run.study().model.types[static_cast<std::size_t>(type)];
            if (!dividing.cycle.phases.empty()) return column->values.front() * std::exp(population_growth_rate(dividing) * sample.time);
            // E[e^(−αT)] = ½ of normal times: α D − (α D c)²/2 = ln 2, c the spread; this to first order in c².
            const double c = dividing.cycle_duration.relative_spread;
            return column->values.front() * std::exp2(sample.time / dividing.cycle_duration.mean * (1.0 + 0.5 * std::numbers::ln2 * c * c));
          }};
}

}  // namespace morula::scenarios
