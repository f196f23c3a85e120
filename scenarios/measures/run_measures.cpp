// What a run has as a whole, beyond the columns of series.csv.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "results/exchanges.h"
#include "scenarios/measures/measures.h"
#include "scenarios/measures/verdicts.h"

namespace morula::scenarios {
namespace {

/// A measure of one row of some columns of series.csv.
Measure of_columns(const char* name, const char* title, const char* doc, const char* formula, Quantity quantity,
                   std::vector<std::string> columns, double (*value)(double time, const std::vector<double>& row)) {
  Measure out{name, title, doc, formula, "", quantity, MeasureOf::kRun};
  out.columns = [columns](const Study&, const Subject&) { return columns; };
  out.take = [columns, value](FinishedRun& run, const Subject&, const Moments& moments) { return by_row(run, columns, moments, value); };
  return out;
}

/// Shortest time for which a cell is known to have kept a body that it was given after time 0: to its next exchange, and where no cell has
/// a second one, to the end of the run for the cell that was exchanged first. Nothing when no cell was exchanged. kFile.
Result<std::vector<Sample>> take_shortest_hold(FinishedRun& run, const Subject&, const Moments& moments) {
  MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
  if (moments.among(*times).empty()) return std::vector<Sample>{};
  const double end = (*times)[moments.among(*times).back()];
  MORULA_TRY_ASSIGN(const std::vector<EventLine>* const events, run.events());
  std::vector<EventLine> exchanges = exchanges_of(*events);
  std::erase_if(exchanges, [&](const EventLine& event) { return event.time == 0.0 || event.time > end; });
  if (exchanges.empty()) return std::vector<Sample>{};
  const std::vector<double> kept = times_between_exchanges(exchanges);
  return std::vector<Sample>{{end, kept.empty() ? end - exchanges.front().time : std::ranges::min(kept), ""}};
}

}  // namespace

Measure mean_contact_part_measure() {
  return of_columns("mean_contact_part", "mean contact area over the surface of a ball of the mean volume",
                    "Mean contact area of a cell over the surface of a ball of the cells' mean volume.", "A_contact/(36 pi V^2)^(1/3)",
                    Quantity::kFraction, {"mean_contact_area", "total_volume", "cell_count"}, [](double, const std::vector<double>& row) {
                      const double volume = row[1] / row[2];
                      return row[0] / std::cbrt(36.0 * std::numbers::pi * volume * volume);
                    });
}

Measure mean_step_measure() {
  return of_columns("mean_step", "mean step", "Simulated time over the number of steps since time 0; nothing before the first.", "t/N",
                    Quantity::kTime, {"step_count"},
                    [](double time, const std::vector<double>& row) { return row[0] > 0.0 ? time / row[0] : kNothing; });
}

Measure shortest_hold_measure() {
  Measure out{
      "shortest_hold",
      "shortest time for which a cell kept a body that it was given",
      "Shortest time between two exchanges of the body of a cell after time 0; without a second one, from the first exchange of any "
      "cell to the end.",
      "",
      "",
      Quantity::kTime,
      MeasureOf::kRun};
  out.take = &take_shortest_hold;
  return out;
}

}  // namespace morula::scenarios
