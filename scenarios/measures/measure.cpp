#include "scenarios/measures/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace morula::scenarios {
namespace {

Result<std::vector<Sample>> take_of_cells(FinishedRun& run, const Subject& subject, const Moments& moments, OfCell value) {
  MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
  std::vector<Sample> out;
  for (const std::size_t index : moments.among(*times)) {
    MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot(index));
    std::vector<std::optional<ShellView>> views(snapshot->cells.size());
    for (const Snapshot::Shell& shell : snapshot->shells)
      views[shell.cell] = ShellView{std::span(snapshot->nodes).subspan(shell.first_node, shell.node_count),
                                    snapshot->topologies[shell.topology], &snapshot->cells[shell.cell]};
    for (std::size_t i = 0; i < snapshot->cells.size(); ++i) {
      const Snapshot::Cell& cell = snapshot->cells[i];
      if (!is_meant(cell, subject)) continue;
      const double found = value(*snapshot, cell, views[i] ? &*views[i] : nullptr);
      if (!std::isnan(found)) out.push_back({snapshot->time, found, cell.id.text()});
    }
  }
  return out;
}

}  // namespace

bool is_meant(const Snapshot::Cell& cell, const Subject& subject) {
  if (!subject.cell.empty()) return cell.id.text() == subject.cell;
  return subject.type < 0 || cell.type == subject.type;
}

Status needs_shells(const Study& study, const Subject& subject) {
  const Model& model = study.model;
  bool may_be = model.swaps.any();
  for (std::size_t type = 0; type < model.types.size(); ++type) {
    may_be = may_be || !model.types[type].fates.all.empty();  // a sister has the body of her mother for a while
    if (subject.type >= 0 && type != static_cast<std::size_t>(subject.type)) continue;
    for (const InitialCells& cells : study.initial)
      may_be = may_be || cells.source == InitialCells::Source::kMeshes ||
               cells.may_begin_as(type, BodyKind::kShell, model.types[type].initial_body);
  }
  return may_be ? Status{} : Error{ErrorKind::kInput, "needs shells, and these cells are always spheres", "`body: shell`"};
}

Measure cell_measure(std::string name, std::string title, std::string doc, Quantity quantity, OfCell value, std::string formula) {
  Measure out{std::move(name), std::move(title), std::move(doc), std::move(formula), "", quantity, MeasureOf::kCells};
  out.take = [value](FinishedRun& run, const Subject& subject, const Moments& moments) {
    return take_of_cells(run, subject, moments, value);
  };
  return out;
}

std::function<Result<std::vector<Sample>>(FinishedRun&, const Subject&, const Moments&)> by_snapshot(OfSnapshot value) {
  return [value = std::move(value)](FinishedRun& run, const Subject& subject, const Moments& moments) -> Result<std::vector<Sample>> {
    MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
    std::vector<Sample> out;
    for (const std::size_t index : moments.among(*times)) {
      MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot(index));
      if (const auto found = value(run.study(), *snapshot, subject)) out.push_back({snapshot->time, *found, ""});
    }
    return out;
  };
}

Result<std::vector<Sample>> by_row(FinishedRun& run, const std::vector<std::string>& columns, const Moments& moments, const OfRow& value) {
  MORULA_TRY_ASSIGN(const SeriesTable* const series, run.series());
  const SeriesColumn* const time = series->find("time");
  std::vector<const SeriesColumn*> found;
  for (const std::string& name : columns) found.push_back(series->find(name));
  std::vector<Sample> out;
  if (time == nullptr || std::find(found.begin(), found.end(), nullptr) != found.end()) return out;
  std::vector<double> row(found.size());
  for (const std::size_t i : moments.among(time->values)) {
    for (std::size_t c = 0; c < found.size(); ++c) row[c] = found[c]->values[i];
    const double one = value(time->values[i], row);
    if (!std::isnan(one)) out.push_back({time->values[i], one, ""});
  }
  return out;
}

std::optional<PairOfShells> shells_of_pair(const Snapshot& snapshot, const Subject& pair) {
  const auto first = shells_of(snapshot, static_cast<std::size_t>(pair.type));
  if (pair.type == pair.partner) return first.size() == 2 ? std::optional(PairOfShells{first[0], first[1]}) : std::nullopt;
  const auto second = shells_of(snapshot, static_cast<std::size_t>(pair.partner));
  return first.size() == 1 && second.size() == 1 ? std::optional(PairOfShells{first[0], second[0]}) : std::nullopt;
}

}  // namespace morula::scenarios
