#include "coupling/behaviours/birth.h"

#include <numbers>

#include "core/random/philox.h"
#include "coupling/behaviours/draw.h"
#include "coupling/behaviours/growth.h"
#include "coupling/behaviours/migration.h"
#include "coupling/behaviours/polarity.h"

namespace morula {

CellState make_founder(CellId id, std::uint16_t type_index, const CellType& type, std::uint32_t seed, double time, bool random_age) {
  CellState row;
  row.id = id;
  row.type = type_index;
  row.body = row.own_body = type.initial_body;
  row.phase = type.cycles ? Phase::kGrowing : Phase::kResting;

  std::uint64_t variability_draws = 0;
  const double radius = draw_truncated(type.radius, Random(seed, RandomStream::kCellVariability), id, variability_draws);
  row.cycle_duration = draw_truncated(type.cycle_duration, Random(seed, RandomStream::kDivisionDuration), id, row.draws);
  row.birth_volume = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  row.division_volume = 2.0 * row.birth_volume;

  const bool aged = random_age && type.cycles;
  const double point = aged ? balanced_growth_age(Random(seed, RandomStream::kInitialPhase).uniform(id, 0).first) : 0.0;
  row.birth_time = time - point * row.cycle_duration;
  row.target_volume = volume_in_cycle(row.birth_volume, row.division_volume, type.exponential_growth, point);
  row.migration_velocity = initial_migration_velocity(id, type, seed);
  row.polarity = initial_polarity(id, type, seed);
  return row;
}

CellState make_daughter(const CellState& mother, int which, const CellType& type, std::uint32_t seed, double time, double birth_volume) {
  CellState row;
  for_each_cell_column([&](const CellColumn& column, auto member) {
    if (column.at_division == AtDivision::kCopied) row.*member = mother.*member;
  });
  row.id = mother.id.daughter(which);
  row.parent = mother.id;
  row.birth_time = time;
  row.birth_volume = birth_volume;
  row.target_volume = birth_volume;
  row.division_volume = 2.0 * birth_volume;
  row.cycle_duration = draw_truncated(type.cycle_duration, Random(seed, RandomStream::kDivisionDuration), row.id, row.draws);
  row.phase = type.cycles ? Phase::kGrowing : Phase::kResting;
  return row;
}

}  // namespace morula
