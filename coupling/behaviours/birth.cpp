#include "coupling/behaviours/birth.h"

#include <array>

#include "core/ball.h"
#include "core/random/philox.h"
#include "coupling/behaviours/balanced_growth.h"
#include "coupling/behaviours/draw.h"
#include "coupling/behaviours/migration.h"
#include "coupling/behaviours/polarity.h"

namespace morula {

CellState make_founder(CellId id, std::uint16_t type_index, const CellType& type, std::uint32_t seed, double time, bool random_age,
                       std::size_t cycle_variables) {
  CellState row;
  row.id = id;
  row.type = type_index;
  row.body = row.own_body = type.initial_body;
  row.phase = type.cycles ? Phase::kGrowing : Phase::kResting;

  std::uint64_t variability_draws = 0;
  const double radius = draw_truncated(type.radius, Random(seed, RandomStream::kCellVariability), id, variability_draws);
  row.birth_time = time;
  row.birth_volume = row.target_volume = ball_volume(radius);
  CyclePlace place = begin_cycle(row, type, seed);
  if (random_age && type.cycles) place = settle_in_balanced_growth(row, type, seed, time);
  set_place(row, type, place, cycle_variables);
  draw_traits(row, type, seed);
  row.migration_velocity = initial_migration_velocity(id, type, seed);
  row.polarity = initial_polarity(id, type, seed);
  return row;
}

CellState make_daughter(const CellState& mother, int which, const CellType& type, std::uint32_t seed, double time, double birth_volume,
                        double mothers_duration, CyclePlace& place) {
  CellState row;
  for_each_cell_column([&](const CellColumn& column, auto member) {
    if (column.at_division == AtDivision::kCopied) row.*member = mother.*member;
  });
  row.id = mother.id.daughter(which);
  row.parent = mother.id;
  row.birth_time = time;
  row.birth_volume = birth_volume;
  row.target_volume = birth_volume;
  place = begin_cycle(row, type, seed, mothers_duration);
  row.phase = type.cycles ? Phase::kGrowing : Phase::kResting;
  return row;
}

void draw_traits(CellState& row, const CellType& type, std::uint32_t seed, const CellState* mother) {
  constexpr std::array kStreams{RandomStream::kTension, RandomStream::kStiffness, RandomStream::kAdhesion};
  for (const Trait trait : kTraits) {
    const std::optional<std::size_t> number = type.traits.variable_of(trait);
    if (!number) continue;
    if (row.variables.size() <= *number) row.variables.resize(*number + 1, 0.0);
    std::uint64_t index = 0;
    const Random random(seed, kStreams[number_of(trait)]);
    const Distribution& factor = type.traits.of(trait);
    row.variables[*number] = (mother == nullptr ? draw_truncated(factor, random, row.id, index)
                                                : draw_inherited(factor, 1.0 + deviation(*mother, type, trait), random, row.id, index)) -
                             1.0;
  }
}

void set_place(CellState& row, const CellType& type, const CyclePlace& place, std::size_t first) {
  if (type.cycle.phases.empty()) return;
  if (row.variables.size() < first + 3) row.variables.resize(first + 3, 0.0);
  row.variables[first] = static_cast<double>(place.phase);
  row.variables[first + 1] = place.left;
  row.variables[first + 2] = place.held;
}

}  // namespace morula
