#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "scenarios/compare/difference.h"
#include "scenarios/compare/run_group.h"

namespace morula::scenarios {

/// What is asked of a comparison.
struct CompareRequest {
  std::vector<std::string> only;  ///< columns of series.csv; empty: those of the tissue, and not of its bodies or of the solver
  std::optional<double> within;   ///< how near is near enough, as a part of the first group's value
  bool every = false;             ///< judged at each common output, else at the last one
  double from = 0.0;              ///< outputs before this time do not count [s]
};

/// A column of series.csv that all runs have.
struct ComparedColumn {
  std::string name, unit;
  std::vector<ColumnDifference> differences;  ///< of the second group, the third, ...
};

struct Comparison {
  std::vector<double> times;            ///< of outputs that all runs have [s]
  std::vector<ComparedColumn> columns;  ///< in the order of the first run's file
  std::vector<std::string> left_out;    ///< columns that are not looked at unless they are named, or that not all runs have
  std::vector<std::string> notes;       ///< what a reader must know
  std::vector<std::string> settings;    ///< paths at which the groups' studies differ
};

/// kInput: no common output, no common column, a column that is not there, a unit that differs.
Result<Comparison> compare(const std::vector<RunGroup>& groups, const CompareRequest& request);

}  // namespace morula::scenarios
