#pragma once
#include <vector>

#include "scenarios/pictures/curves.h"
#include "scenarios/report/series_reader.h"
#include "scenarios/study/study.h"

namespace morula::scenarios {

/// A plot and the name of its files.
struct NamedPlot {
  std::string name;
  CurvePlot plot;
};

/// The curves every run gets (UX, section 6), of the columns that are in the series: cells by body and by type, size, step, volume error,
/// overlap and field balance against their limits, pressure, contact, energy, fields. Time in hours, or minutes for short runs.
std::vector<NamedPlot> standard_plots(const Study& study, const SeriesTable& series);

}  // namespace morula::scenarios
