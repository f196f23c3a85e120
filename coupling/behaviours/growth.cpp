#include "coupling/behaviours/growth.h"

#include <algorithm>

#include "core/ball.h"
#include "core/random/philox.h"
#include "coupling/behaviours/draw.h"

namespace morula {

GrowthPace growth_pace(const CellRow& row, const CellType& type) {
  const CellCycle& cycle = type.cycle;
  if (cycle.control == SizeControl::kTimer) return {row.birth_volume, row.division_volume, row.cycle_duration};
  const double radius = type.radius.mean, birth = ball_volume(radius);
  return {birth, cycle.ratio * birth, row.cycle_duration};
}

double division_volume(const CellRow& row, const CellType& type, std::uint32_t seed) {
  const CellCycle& cycle = type.cycle;
  std::uint64_t index = 0;
  const double factor = draw_truncated({1.0, cycle.size_spread}, Random(seed, RandomStream::kDivisionSize), row.id, index);
  switch (cycle.control) {
    case SizeControl::kTimer:
      break;
    case SizeControl::kSizer:
      return cycle.size * factor;
    case SizeControl::kAdder:
      return row.birth_volume + cycle.size * factor;
  }
  return cycle.size_spread > 0.0 ? row.birth_volume * (1.0 + (cycle.ratio - 1.0) * factor) : cycle.ratio * row.birth_volume;
}

double time_to_grow(const CellRow& row, const CellType& type) {
  if (type.cycle.control == SizeControl::kTimer) return row.cycle_duration;
  return std::max(0.0, type.cycle.growth->time_to(growth_pace(row, type), type.cycle.growth_values, row.birth_volume, row.division_volume));
}

double volume_in_cycle(const CellRow& row, const CellType& type, double point) {
  const CellCycle& cycle = type.cycle;
  const GrowthPace pace = growth_pace(row, type);
  if (cycle.control == SizeControl::kTimer) return cycle.growth->at(pace, cycle.growth_values, point);
  return cycle.growth->after(pace, cycle.growth_values, row.birth_volume, point * time_to_grow(row, type));
}

Growth grow(CellRow& row, const CellType& type, double dt) {
  // A sum of many steps ends a rounding away from the division volume: that much early counts as reached.
  constexpr double kRounding = 1e-9;
  if (!type.cycles || !may_grow(row, type)) return {};
  const CellCycle& cycle = type.cycle;
  const GrowthPace pace = growth_pace(row, type);
  const double needed = cycle.growth->time_to(pace, cycle.growth_values, row.target_volume, row.division_volume);
  if (needed > dt * (1.0 + kRounding) + kRounding * row.cycle_duration) {
    row.target_volume = cycle.growth->after(pace, cycle.growth_values, row.target_volume, dt);
    return {};
  }
  row.target_volume = std::max(row.target_volume, row.division_volume);
  return {true, std::clamp(dt - needed, 0.0, dt)};
}

}  // namespace morula
