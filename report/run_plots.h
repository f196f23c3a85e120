#pragma once
#include <vector>

#include "report/pictures/curves.h"
#include "results/series_reader.h"
#include "study/study.h"

namespace morula::scenarios {

/// A plot and the name of its files.
struct NamedPlot {
  std::string name;
  CurvePlot plot;
  bool numerics = false;  ///< about steps and solver: below a fold in the report
};

/// The curves every run gets (UX, section 6), of the columns that are in the series: cells by body and by type, size, step, volume error,
/// overlap and field balance against their limits, pressure, contact, energy, cavities, fields. Time in seconds, minutes or hours. A curve
/// that is zero all the time or the same as one before it is left out, and so is a plot in which nothing changes (but those against
/// limits).
std::vector<NamedPlot> standard_plots(const Study& study, const SeriesTable& series);

}  // namespace morula::scenarios
