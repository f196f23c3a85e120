#include "scenarios/measures/stretched_cells.h"
#include "scenarios/measures/elastic_cap.h"

#include "core/ball.h"
#include "scenarios/measures/holds.h"
#include "scenarios/measures/single_cell.h"

namespace morula::scenarios {

Result<std::vector<StretchedCell>> stretched_cells(FinishedRun& run, std::size_t number, const Moments& moments, StretchedFrom from) {
  const CellLoad& load = run.study().model.loads[number];
  const CellType& type = run.study().model.types[load.type];
  std::vector<StretchedCell> out;
  MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
  const auto holds = holds_of(load.course, *times);
  if (holds.empty() || holds.front().value != 0.0) return out;
  MORULA_TRY_ASSIGN(const auto rest, run.snapshot(from == StretchedFrom::kStart ? 0 : holds.front().output));
  const auto before = shells_of(*rest, load.type);
  for (const std::size_t index : moments.among(*times)) {
    MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot(index));
    const auto after = shells_of(*snapshot, load.type);
    const double stress = load.size * load.course.at(snapshot->time);
    for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i)
      out.push_back({after[i].cell->id.text(), snapshot->time, stress, fit_second_mode(before[i], after[i], load.axis),
                     theory::stretched_sphere(stress, ball_radius(before[i].cell->volume), spring_modulus(type), 1.0 / 3.0,
                                              tension_at(type, snapshot->time), type.shell.bulk_modulus)});
  }
  return out;
}

}  // namespace morula::scenarios
