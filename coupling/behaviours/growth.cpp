#include "coupling/behaviours/growth.h"

#include <algorithm>
#include <cmath>

namespace morula {

double volume_in_cycle(double birth_volume, double division_volume, bool exponential, double point) {
  if (exponential) return birth_volume * std::pow(division_volume / birth_volume, point);
  return birth_volume + (division_volume - birth_volume) * point;
}

Growth grow(CellRow& row, const CellType& type, double dt) {
  // A sum of many steps ends a rounding away from the division volume: that much early counts as reached.
  constexpr double kRounding = 1e-9;
  if (!type.cycles || row.pressure > type.inhibit_pressure) return {};
  double needed = 0.0;
  if (type.exponential_growth) {
    const double whole = std::log(row.division_volume / row.birth_volume);
    needed = row.cycle_duration * std::log(row.division_volume / row.target_volume) / whole;
    if (needed > dt * (1.0 + kRounding) + kRounding * row.cycle_duration) {
      row.target_volume *= std::exp(whole * dt / row.cycle_duration);
      return {};
    }
  } else {
    const double whole = row.division_volume - row.birth_volume;
    needed = row.cycle_duration * (row.division_volume - row.target_volume) / whole;
    if (needed > dt * (1.0 + kRounding) + kRounding * row.cycle_duration) {
      row.target_volume += whole * dt / row.cycle_duration;
      return {};
    }
  }
  row.target_volume = row.division_volume;
  return {true, std::clamp(dt - needed, 0.0, dt)};
}

}  // namespace morula
