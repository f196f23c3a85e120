// What a body cannot do yet, or can do only outside the range of its law.
#include <algorithm>
#include <cmath>

#include "scenarios/study/build.h"
#include "scenarios/study/read_section.h"

namespace morula::scenarios {
namespace {

/// Random forces belong to the friction element by element; those inside a cell have none.
void check_noise_inside(BuildContext& c) {
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i) {
    const auto& [name, place, t] = c.draft.cell_types[i];
    const CellType& type = c.study.model.types[i];
    if (!t.activity.has_fluctuations || !(type.fluctuations.energy > 0.0) || !may_be_shell(c, i)) continue;
    const bool nucleus = type.interior.has_nucleus();
    if (!nucleus && !type.interior.cortex_links.act()) continue;
    c.diagnostics.error(645, t.activity.energy.place,
                        "cells of '" + name + "' fluctuate, but the friction of their " + (nucleus ? "nucleus" : "cytoskeleton") +
                            " has no noise: it would cool the cortex",
                        nucleus ? "leave out `fluctuations`, or the nucleus" : "leave out `fluctuations`, or `cytoskeleton`");
  }
}

/// Whether a cell of the type can reach its division volume before the run ends.
bool may_divide(const BuildContext& c, std::size_t type) {
  const CellType& of = c.study.model.types[type];
  if (!of.cycles) return false;
  const double shortest = of.cycle_duration.mean * (1.0 - 3.0 * of.cycle_duration.relative_spread);
  if (shortest < c.study.time.end) return true;
  return std::ranges::any_of(c.study.initial, [&](const InitialCells& block) { return block.random_age && block.type == type; }) ||
         std::ranges::any_of(c.draft.initial, [](const auto& block) { return block.content.csv.given; });
}

void check_division_of_shells(BuildContext& c) {
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i) {
    const auto& [name, place, t] = c.draft.cell_types[i];
    if (!may_be_shell(c, i) || !may_divide(c, i)) continue;
    const bool always = c.study.model.types[i].initial_body == BodyKind::kShell && c.study.model.swaps.regions.empty();
    c.diagnostics.warning(646, t.cycle_duration.mean.given ? t.cycle_duration.mean.place : place,
                          "cells of '" + name + "' have a cycle, but " + (always ? "are shells" : "may be shells") +
                              ", which cannot divide yet: at its division volume a shell stops growing and waits until it is a sphere",
                          "leave out `cycle`, let cells that divide be spheres, or end the run before");
  }
}

}  // namespace

void check_bodies(BuildContext& c) {
  check_noise_inside(c);
  check_division_of_shells(c);
}

}  // namespace morula::scenarios
