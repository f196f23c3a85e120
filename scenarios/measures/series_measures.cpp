// Every column of series.csv is a measure by its name.
#include <algorithm>

#include "coupling/observables/observable.h"
#include "scenarios/measures/measures.h"

namespace morula::scenarios {
namespace {

/// The quantity whose internal unit is that of a column; a plain number where no quantity has it.
Quantity quantity_of(const std::string& unit) {
  const UnitSystem units;
  for (int q = static_cast<int>(Quantity::kAngle); q < kQuantityCount; ++q)
    if (const auto factor = units.factor(unit, static_cast<Quantity>(q)); factor.ok() && *factor == 1.0) return static_cast<Quantity>(q);
  return Quantity::kNumber;
}

}  // namespace

std::optional<Measure> series_measure(const Study& study, const std::string& column) {
  const auto all = observables(study.model, *study.laws);
  const auto found = std::find_if(all.begin(), all.end(), [&](const Observable& o) { return o.name == column; });
  if (found == all.end()) return std::nullopt;
  std::string title = column;
  std::replace(title.begin(), title.end(), '_', ' ');
  Measure out{column, title, found->doc, "", "", quantity_of(found->unit), MeasureOf::kRun};
  out.columns = [column](const Study&, const Subject&) { return std::vector<std::string>{column}; };
  out.take = [column](FinishedRun& run, const Subject&, const Moments& moments) {
    return by_row(run, {column}, moments, [](double, const std::vector<double>& row) { return row[0]; });
  };
  return out;
}

}  // namespace morula::scenarios
