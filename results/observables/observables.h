#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/result.h"
#include "coupling/tissue.h"
#include "results/observables/measures.h"

namespace morula::scenarios {

/// What a column of series.csv is computed from.
struct Moment {
  const Measures& measures;
  const Interval& interval;
  const Clock& clock;
  const Ledger& ledger;
};

/// A column of series.csv.
struct Observable {
  std::string name;
  std::string unit;  ///< "1" for a number
  std::string doc;   ///< one sentence
  std::function<double(const Moment&)> value;
};

/// All observables that a run of this model has: the general ones, then one count per cell type and three numbers per field.
std::vector<Observable> observables(const Model& model);

/// Their names, for the study reader (ReadOptions::series_names).
std::vector<std::string> observable_names(const Model& model);

/// The observables with these names, in that order; all of them where none is named. kInput for a name that is not there.
Result<std::vector<Observable>> select_observables(const Model& model, const std::vector<std::string>& names);

}  // namespace morula::scenarios
