#include <numbers>

#include "coupling/behaviours/persistence.h"

namespace morula {
namespace {

Vec3d at_birth(const MigratingCell& cell, const OwnValues&) { return cell.speed / std::numbers::sqrt3 * cell.normal(); }

/// σ = S/√3.
Walk step(const MigratingCell& cell, const OwnValues& own) {
  return walk_about({}, cell.speed / std::numbers::sqrt3, own("persistence"), cell);
}

}  // namespace

OwnKey persistence_key() {
  return {.spec = {.name = "persistence",
                   .doc = "Time over which the direction is remembered.",
                   .quantity = Quantity::kTime,
                   .fallback = "30 min",
                   .low = 0.0,
                   .low_open = true,
                   .example = "30 min",
                   .source = "chosen"}};
}

OwnValues usual_walk() {
  OwnValues out;
  out.set("persistence", 1800.0);
  return out;
}

/// Persistent random walk as an Ornstein–Uhlenbeck process of the wanted velocity u, which has the variance S²/3 per component.
std::shared_ptr<const MigrationLaw> persistent_walk() {
  static const auto law = std::make_shared<const MigrationLaw>(MigrationLaw{
      .info =
          {.name = "persistent_walk",
           .title = "Persistent random migration",
           .equation =
               "F = Γ w on every point, Γ its friction with the medium and with obstacles; w = u in the open, √(3/2) u∥ on an obstacle; "
               "du = −u dt/P + (S/√3)√(2/P) dB per component; MSD = 2S²P[t − P(1 − e^(−t/P))] in the open",
           .source = "Uhlenbeck & Ornstein 1930, doi:10.1103/PhysRev.36.823",
           .parameters = {given_by_study("speed", "velocity", "µm/s", "S: root mean square of the wanted velocity in three dimensions."),
                          given_by_study("persistence", "time", "s", "P: time over which direction is kept.")}},
      .doc = "the velocity changes all the time, with normal increments (Ornstein-Uhlenbeck)",
      .keys = {persistence_key()},
      .at_birth = &at_birth,
      .step = &step});
  return law;
}

}  // namespace morula
