#include "coupling/behaviours/death.h"

#include <cmath>

#include "core/random/philox.h"

namespace morula {

bool begins_to_die(const CellRow& row, const CellType& type, std::uint32_t seed, std::uint64_t step, double dt) {
  if (row.phase == Phase::kDying || type.death_field < 0 || type.death_rate <= 0.0) return false;
  if (!(row.concentration[static_cast<std::size_t>(type.death_field)] < type.death_below)) return false;
  const double probability = -std::expm1(-type.death_rate * dt);
  return Random(seed, RandomStream::kDeath).uniform(row.id, step).first < probability;
}

void start_dying(CellRow& row, double time) {
  row.phase = Phase::kDying;
  row.death_time = time;
  row.migration_velocity = {};
}

void shrink(CellRow& row, const CellType& type, double dt) { row.target_volume *= std::exp(-dt / type.apoptosis_time); }

bool is_gone(const CellRow& row, const CellType& type, double time) {
  constexpr double kRounding = 1e-12;  // of the clock: the step that lands on the moment counts
  const double life_left = -type.apoptosis_time * std::log(type.removal_fraction);
  return row.phase == Phase::kDying && time - row.death_time >= life_left * (1.0 - kRounding);
}

}  // namespace morula
