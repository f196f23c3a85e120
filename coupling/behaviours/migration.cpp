#include "coupling/behaviours/migration.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/numbers/cube_root.h"
#include "core/random/philox.h"

namespace morula {
namespace {

/// Three independent standard normal numbers: the draws 2·index and 2·index + 1 of the migration stream.
Vec3d normal_vector(CellId cell, std::uint32_t seed, std::uint64_t index) {
  const Random random(seed, RandomStream::kMigration);
  const RandomPair one = random.normal(cell, 2 * index);
  const RandomPair two = random.normal(cell, 2 * index + 1);
  return {one.first, one.second, two.first};
}

double deviation(const CellType& type) { return type.migration_speed / std::numbers::sqrt3; }

}  // namespace

Vec3d next_migration_velocity(const Vec3d& velocity, CellId cell, const CellType& type, std::uint32_t seed, std::uint64_t step, double dt) {
  if (type.migration_speed <= 0.0) return {};
  const double kept = std::exp(-dt / type.migration_persistence);
  const double renewed = deviation(type) * std::sqrt(-std::expm1(-2.0 * dt / type.migration_persistence));
  return kept * velocity + renewed * normal_vector(cell, seed, step);
}

Vec3d initial_migration_velocity(CellId cell, const CellType& type, std::uint32_t seed) {
  if (type.migration_speed <= 0.0) return {};
  constexpr std::uint64_t kBeforeAllSteps = std::numeric_limits<std::uint64_t>::max() / 2;  // no step has this number
  return deviation(type) * normal_vector(cell, seed, kBeforeAllSteps);
}

double medium_friction_of(double friction, double volume) {
  const double radius = cube_root(0.75 * volume / std::numbers::pi);
  return friction * 4.0 * std::numbers::pi * radius * radius;
}

Vec3d migration_force(const Vec3d& wanted, const CellType& type, double volume) {
  return medium_friction_of(type.medium_friction, volume) * wanted;
}

}  // namespace morula
