#include "coupling/behaviours/death.h"

#include <cmath>

#include "core/random/philox.h"

namespace morula {

bool begins_to_die(const CellRow& row, double seen, const CellType& type, std::uint32_t seed, std::uint64_t step, double dt) {
  if (row.phase == Phase::kDying || type.death_field < 0 || type.death_rate <= 0.0) return false;
  if (!(seen < type.death_below)) return false;
  const double probability = -std::expm1(-type.death_rate * dt);
  return Random(seed, RandomStream::kDeath).uniform(row.id, step).first < probability;
}

void shrink(CellRow& row, const CellType& type, double dt) { row.target_volume *= std::exp(-dt / type.apoptosis_time); }

bool is_gone(double death_time, const CellType& type, double time) {
  constexpr double kRounding = 1e-12;  // of the clock: the step that lands on the moment counts
  const double life_left = -type.apoptosis_time * std::log(type.removal_fraction);
  return time - death_time >= life_left * (1.0 - kRounding);
}

}  // namespace morula
