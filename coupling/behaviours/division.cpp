#include "coupling/behaviours/division.h"

#include <cassert>

#include "cbm/division_ramp.h"
#include "core/numbers/cube_root.h"
#include "coupling/behaviours/birth.h"
#include "coupling/behaviours/growth.h"

namespace morula {

DaughterRows divide_row(const CellState& mother, std::span<const VariableColumn> variables, const CellType& type, std::uint32_t seed,
                        double time, double late, double fraction) {
  assert(mother.id.can_divide() && fraction > 0.0 && fraction < 1.0);
  const double volume_1 = fraction * mother.target_volume;
  const double volume_2 = mother.target_volume - volume_1;

  DaughterRows out;
  out.share = volume_1 / mother.target_volume;
  const double birth = time - late;
  CyclePlace place_1, place_2;
  out.first = make_daughter(mother, 0, type, seed, birth, volume_1, place_1);
  out.second = make_daughter(mother, 1, type, seed, birth, volume_2, place_2);
  divide_variables(variables, mother, out.first, out.second);
  for (CellState* daughter : {&out.first, &out.second}) draw_traits(*daughter, type, seed, &mother);
  const std::size_t first = first_cycle_variable(variables);
  const auto go_on = [&](CellState& daughter, CyclePlace& place) {
    if (late > 0.0 && type.cycle.phases.empty()) grow(daughter, type, late);
    if (late > 0.0 && !type.cycle.phases.empty()) pass_phases(daughter, place, type, seed, late, 1.0, [](std::size_t) { return 1.0; });
    set_place(daughter, type, place, first);
  };
  go_on(out.first, place_1);
  go_on(out.second, place_2);
  return out;
}

SphereDivision divide_sphere(const SphereBody& body, const Vec3d& axis, double share) {
  SphereDivision out;
  const double rest = 1.0 - share;
  out.first.radius = body.radius * cube_root(share);
  out.second.radius = body.radius * cube_root(rest);
  const double distance = cbm::sister_distance(out.first.radius, out.second.radius);
  out.first.position = body.position + (distance * rest) * axis;
  out.second.position = body.position - (distance * share) * axis;
  return out;
}

void divide_variables(std::span<const VariableColumn> variables, const CellState& mother, CellState& first, CellState& second) {
  assert(first.birth_volume > 0.0 && first.birth_volume < mother.target_volume);
  const double part = first.birth_volume / mother.target_volume;
  const auto daughter = [&](bool is_first) {
    std::vector<double> out;
    for (std::size_t v = 0; v < variables.size(); ++v) {
      const double mothers = mother.variable(v), shared = part * mothers;
      const AtDivision rule = variables[v].what.at_division;
      out.push_back(rule == AtDivision::kCopied ? mothers : rule != AtDivision::kShared ? 0.0 : is_first ? shared : mothers - shared);
    }
    return out;
  };
  first.variables = daughter(true);
  second.variables = daughter(false);
}

}  // namespace morula
