#include "study/build.h"
#include "study/initial/judge_places.h"

namespace morula::scenarios {
namespace {

constexpr std::uint64_t kMostCells = 5000;  // whose places are made in a check: about a second

Place place_of(const BuildContext& c, std::size_t entry) {
  const auto& [name, place, d] = c.draft.initial[entry];
  if (d.at.given) return d.at.place;
  if (d.csv.given) return d.csv.place;
  if (d.fill.given) return d.fill.place;
  return place;
}

void tell(BuildContext& c, const PlaceProblem& problem) {
  const Place place = place_of(c, problem.entry);
  if (problem.is_warning)
    c.diagnostics.warning(problem.code, place, problem.text, problem.help);
  else
    c.diagnostics.error(problem.code, place, problem.text, problem.help);
}

}  // namespace

void check_places(BuildContext& c) {
  if (!c.options.judge_places || c.diagnostics.has_errors() || c.study.initial.empty()) return;
  std::uint64_t count = 0;
  for (const InitialCells& block : c.study.initial) count += block.count;
  if (count > kMostCells) {
    c.study.notes.push_back("the places of " + std::to_string(count) +
                            " cells are found and judged when the run begins: a check looks at " + std::to_string(kMostCells) + " at most");
    return;
  }
  const auto failed = [&c](const Error& error) { c.diagnostics.error(659, c.draft.initial[0].place, error.message, error.help); };
  auto placed = place_cells(c.study);
  if (!placed.ok()) return failed(placed.error());
  for (const PlaceProblem& problem : placed->problems) tell(c, problem);
  if (!placed->problems.empty()) return;
  auto around = Surroundings::of(c.study.model);
  if (!around.ok()) return failed(around.error());
  auto judged = judge_places(c.study, placed->cells, *around);
  if (!judged.ok()) return failed(judged.error());
  for (const PlaceProblem& problem : judged->problems) tell(c, problem);
  for (std::vector<std::string>* notes : {&placed->notes, &judged->notes})
    c.study.notes.insert(c.study.notes.end(), notes->begin(), notes->end());
}

}  // namespace morula::scenarios
