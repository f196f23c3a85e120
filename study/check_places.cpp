#include "cbm/laws/sphere_caps.h"
#include "core/contact/broad_phase.h"
#include "core/numbers/number_text.h"
#include "coupling/cell_variables.h"
#include "coupling/swaps.h"
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

/// The volume of each ball behind the planes in which it meets others [µm³].
std::vector<double> caps_of_balls(const std::vector<Vec3d>& center, const std::vector<double>& radius, const Space& space) {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < center.size(); ++i) balls.push_back({center[i], radius[i]});
  std::vector<double> caps(balls.size());
  find_ball_pairs(balls, space, [&](const BodyPair& pair) {
    const double distance = norm(center[pair.b] + pair.shift - center[pair.a]);
    const cbm::SphereCaps both = cbm::sphere_caps(radius[pair.a], radius[pair.b], distance);
    caps[pair.a] += both.volume_a, caps[pair.b] += both.volume_b;
  });
  return caps;
}

/// Spheres overlap behind the planes in which they meet, shells do not: room that those who become shells before the first step take beside what pressure asks for.
void tell_room(BuildContext& c, const std::vector<PlacedCell>& placed) {
  Tissue tissue;
  tissue.cells.declare(cell_variables(c.study.model));
  std::vector<Vec3d> center;
  std::vector<double> radius;
  for (const PlacedCell& cell : placed) {
    tissue.cells.push_back(cell.row);
    center.push_back(cell.center), radius.push_back(cell.radius());
    for (std::size_t f = 0; f < c.study.model.fields.size(); ++f)
      tissue.cells.variables[concentration_of(f)].values.set(tissue.cells.size() - 1, c.study.model.fields[f].initial);
  }
  const std::vector<SwapOrder> orders = choose_swaps(c.study.model, tissue, {.center = center}, Comm());
  const std::vector<double> caps = caps_of_balls(center, radius, c.study.model.space);
  double room = 0.0, volume = 0.0;
  std::size_t count = 0;
  for (const SwapOrder& order : orders) {
    if (order.to != BodyKind::kShell) continue;
    room += caps[order.row], volume += tissue.cells.rows[order.row].target_volume, ++count;
  }
  constexpr double kMuch = 1e-3;  // of their volume
  if (room > kMuch * volume)
    c.study.notes.push_back(std::to_string(count) + (count == 1 ? " cell becomes a shell" : " cells become shells") +
                            " before the first step: as spheres they overlap by " + number_text("%.3g um^3", room) + " (" +
                            number_text("%.2g %%", 100.0 * room / volume) + " of their volume), and shells do not: they take that room");
}

/// A cavity is looked into from its centre: from within a cell nothing else is seen.
void check_cavities(BuildContext& c, const std::vector<PlacedCell>& placed) {
  for (std::size_t k = 0; k < c.study.model.lumens.size(); ++k) {
    const Lumen& lumen = c.study.model.lumens[k];
    const auto& [name, place, d] = c.draft.lumens[k];
    if (!lumen.by_sight || lumen.from > 0.0) continue;  // later cells lie elsewhere
    const Space& space = c.study.model.space;
    const auto covers = [&](const PlacedCell& cell) { return norm(space.nearest_image(cell.center - lumen.center)) < cell.radius(); };
    const auto cell = std::ranges::find_if(placed, covers);
    if (cell == placed.end()) continue;
    c.diagnostics.error(557, d.center.place,
                        "the centre of the cavity '" + name + "' lies in a cell, from which nothing of a cavity is seen",
                        "a point between the cells, or `from` a time at which one is there");
  }
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
  tell_room(c, placed->cells);
  check_cavities(c, placed->cells);
  for (std::vector<std::string>* notes : {&placed->notes, &judged->notes})
    c.study.notes.insert(c.study.notes.end(), notes->begin(), notes->end());
}

}  // namespace morula::scenarios
