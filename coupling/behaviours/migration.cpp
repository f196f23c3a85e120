#include "coupling/behaviours/migration.h"

#include <cmath>
#include <limits>
#include <numbers>

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

Vec3d next_migration_velocity(const Vec3d& velocity, CellId cell, const CellType& type, std::uint32_t seed, std::uint64_t step, double dt,
                              double factor) {
  if (type.migration_speed <= 0.0) return {};
  const double kept = std::exp(-dt / type.migration_persistence);
  const double renewed = factor * deviation(type) * std::sqrt(-std::expm1(-2.0 * dt / type.migration_persistence));
  return kept * velocity + renewed * normal_vector(cell, seed, step);
}

Vec3d initial_migration_velocity(CellId cell, const CellType& type, std::uint32_t seed) {
  if (type.migration_speed <= 0.0) return {};
  constexpr std::uint64_t kBeforeAllSteps = std::numeric_limits<std::uint64_t>::max() / 2;  // no step has this number
  return deviation(type) * normal_vector(cell, seed, kBeforeAllSteps);
}

Vec3d crawling_velocity(const Vec3d& wanted, bool touches, const Vec3d& normal, bool needs_substrate) {
  if (!touches) return needs_substrate ? Vec3d{} : wanted;
  const Vec3d across = normal * dot(wanted, normal);
  const Vec3d along = (wanted - across) * std::sqrt(1.5);  // two of three components
  return needs_substrate ? along : along + across;
}

}  // namespace morula
