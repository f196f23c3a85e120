#include "coupling/behaviours/death.h"

#include <cmath>

namespace morula {

void shrink(CellRow& row, const CellType& type, double dt) { row.target_volume *= std::exp(-dt / type.apoptosis_time); }

bool is_gone(double death_time, const CellType& type, double time) {
  constexpr double kRounding = 1e-12;  // of the clock: the step that lands on the moment counts
  const double life_left = -type.apoptosis_time * std::log(type.removal_fraction);
  return time - death_time >= life_left * (1.0 - kRounding);
}

}  // namespace morula
