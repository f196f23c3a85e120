#include "coupling/behaviours/division.h"

#include <cassert>

#include "cbm/division_ramp.h"
#include "core/numbers/cube_root.h"
#include "coupling/behaviours/birth.h"
#include "coupling/behaviours/growth.h"
#include "coupling/behaviours/migration.h"
#include "coupling/behaviours/polarity.h"

namespace morula {

std::array<std::uint16_t, 2> fate_of(const CellState& mother, const CellType& type, std::uint32_t seed) {
  if (!type.fates.all.empty()) {
    double left = Random(seed, RandomStream::kFate).uniform(mother.id, 0).first;
    for (const Fate& fate : type.fates.all)
      if ((left -= fate.share) < 0.0) return fate.type;
  }
  return {mother.type, mother.type};
}

namespace {

/// What a daughter has of her mother's polarity; of a type without one none.
Vec3d daughters_polarity(const CellState& mother, const CellState& daughter, bool is_first, const CellType& of_mother, const CellType& type,
                         std::uint32_t seed) {
  const DaughterPolarity rule = of_mother.fates.polarity;
  const Vec3d mothers = !is_first && rule == DaughterPolarity::kMirrored ? -mother.polarity : mother.polarity;
  if (daughter.type == mother.type) return rule == DaughterPolarity::kNew ? initial_polarity(daughter.id, type, seed) : mothers;
  if (!type.polarity.set) return {};
  return rule == DaughterPolarity::kNew || !of_mother.polarity.set ? initial_polarity(daughter.id, type, seed) : mothers;
}

}  // namespace

DaughterRows divide_row(const CellState& mother, std::span<const VariableColumn> variables, const CellType& type, std::uint32_t seed,
                        double time, double late, double fraction, std::span<const CellType> types) {
  assert(mother.id.can_divide() && fraction > 0.0 && fraction < 1.0);
  const double volume_1 = fraction * mother.target_volume;
  const double volume_2 = mother.target_volume - volume_1;
  const std::array<std::uint16_t, 2> becomes = fate_of(mother, type, seed);

  DaughterRows out;
  out.share = volume_1 / mother.target_volume;
  const double birth = time - late;
  std::array<CellState*, 2> daughters{&out.first, &out.second};
  std::array<CyclePlace, 2> place;
  const auto type_of = [&](int which) -> const CellType& { return becomes[which] == mother.type ? type : types[becomes[which]]; };
  for (const int which : {0, 1}) {
    const CellType& own = type_of(which);
    CellState& daughter = *daughters[which];
    daughter = make_daughter(mother, which, own, seed, birth, which == 0 ? volume_1 : volume_2,
                             mother.cycle_duration * (own.cycle_duration.mean / type.cycle_duration.mean), place[which]);
    daughter.type = becomes[which];
    daughter.polarity = daughters_polarity(mother, daughter, which == 0, type, own, seed);
    if (becomes[which] == mother.type) continue;
    daughter.migration_velocity = initial_migration_velocity(daughter.id, own, seed);
    if (own.initial_body != type.initial_body) daughter.own_body = own.initial_body;
  }
  divide_variables(variables, mother, out.first, out.second);
  const std::size_t first = first_cycle_variable(variables);
  for (const int which : {0, 1}) {
    const CellType& own = type_of(which);
    CellState& daughter = *daughters[which];
    draw_traits(daughter, own, seed, &mother);
    if (late > 0.0 && own.cycle.phases.empty()) grow(daughter, own, late);
    if (late > 0.0 && !own.cycle.phases.empty()) pass_phases(daughter, place[which], own, seed, late, 1.0, [](std::size_t) { return 1.0; });
    set_place(daughter, own, place[which], first);
  }
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
