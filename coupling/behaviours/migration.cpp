#include "coupling/behaviours/migration.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace morula {

// What only the list below names is declared here, so that one more law is its own file and two lines of this one.
std::shared_ptr<const MigrationLaw> run_and_tumble();
std::shared_ptr<const MigrationLaw> chemotaxis();

namespace {

constexpr std::uint64_t kBeforeAllSteps = std::numeric_limits<std::uint64_t>::max() / 2;  // no step has this number

}  // namespace

Vec3d MigratingCell::normal() const {
  const RandomPair one = random.normal(id, 2 * step), two = random.normal(id, 2 * step + 1);
  return {one.first, one.second, two.first};
}

Vec3d MigratingCell::other_normal() const {
  const RandomPair one = random.normal(id, kFurther + 2 * step), two = random.normal(id, kFurther + 2 * step + 1);
  return {one.first, one.second, two.first};
}

std::vector<std::shared_ptr<const MigrationLaw>> migration_laws() { return {persistent_walk(), run_and_tumble(), chemotaxis()}; }

Walk migrate(const MigratingCell& cell, const CellType& type) {
  return type.migration.acts() ? type.migration.law->step(cell, type.migration.own) : Walk{};
}

Vec3d initial_migration_velocity(CellId cell, const CellType& type, std::uint32_t seed) {
  if (!type.migration.acts()) return {};
  const MigratingCell founder{
      .id = cell, .speed = type.migration.speed, .random = Random(seed, RandomStream::kMigration), .step = kBeforeAllSteps};
  return type.migration.law->at_birth(founder, type.migration.own);
}

Vec3d crawling_velocity(const Vec3d& wanted, bool touches, const Vec3d& normal, bool needs_substrate) {
  if (!touches) return needs_substrate ? Vec3d{} : wanted;
  const Vec3d across = normal * dot(wanted, normal);
  const Vec3d along = (wanted - across) * std::sqrt(1.5);  // two of three components
  return needs_substrate ? along : along + across;
}

}  // namespace morula
