#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/cell_id.h"
#include "core/own_keys.h"
#include "core/random/philox.h"
#include "core/vec3.h"
#include "coupling/own_values.h"

namespace morula {

/// What a cell senses of a field: the mean of it at six points a radius away from the cell's centre along the axes, and the difference between opposite ones
/// over their distance.
struct SensedField {
  double concentration = 0.0;  ///< [mM]
  Vec3d gradient{};            ///< [mM/µm]
};

/// A cell that moves by itself, as the law of its migration sees it.
struct MigratingCell {
  CellId id;
  Vec3d velocity{};      ///< that it wants [µm/s]
  double speed = 0.0;    ///< S: that of its type times what its behaviours ask for [µm/s]
  double radius = 0.0;   ///< of a ball of its target volume [µm]
  SensedField sensed{};  ///< where the law looks at a field
  Random random;         ///< of the stream of migration
  std::uint64_t step = 0;
  double dt = 0.0;  ///< length of the step [s]

  /// Three independent standard normal numbers of this cell and step, and three others.
  [[nodiscard]] Vec3d normal() const;
  [[nodiscard]] Vec3d other_normal() const;
  /// The pieces of a step in which a cell turns more than once: a uniform number in (0, 1) and a direction for each k < kPieces.
  static constexpr std::uint64_t kPieces = 1024;
  [[nodiscard]] double uniform(std::uint64_t k) const { return random.uniform(id, kOfPieces + 2 * (step * kPieces + k)).first; }
  [[nodiscard]] Vec3d direction(std::uint64_t k) const { return random.direction(id, kOfPieces + 2 * (step * kPieces + k) + 1); }
  /// A uniform number in (0, 1), and a direction that is independent of it, of this cell and step.
  [[nodiscard]] double uniform() const { return random.uniform(id, 2 * step).first; }
  [[nodiscard]] Vec3d direction() const { return random.direction(id, 2 * step + 1); }

  /// Where the numbers of further draws of a step begin, and of those of its pieces.
  static constexpr std::uint64_t kFurther = std::uint64_t{1} << 62, kOfPieces = std::uint64_t{1} << 63;
};

/// A step of a cell that moves by itself.
struct Walk {
  Vec3d velocity{};  ///< that it wants at the end [µm/s]
  Vec3d mean{};      ///< of that over the step: what it goes by
};

/// A law by which the velocity changes that a cell wants: what there is to say about it, and its solution, exact whatever the steps while what it senses
/// stays the same, in velocity and way. What follows from the velocity where the cell is: crawling_velocity() in migration.h.
struct MigrationLaw {
  LawInfo info;                ///< info.name is the word of `migration.law`
  std::string doc;             ///< what it is, after the word and a colon
  std::vector<OwnKey> keys{};  ///< of its own, beside those of `migration`; laws may share one
  bool senses_field = false;   ///< that its key `field` names
  /// The velocity of a founder [µm/s], and a step of one that is `cell.velocity` at its start.
  Vec3d (*at_birth)(const MigratingCell& cell, const OwnValues& values) = nullptr;
  Walk (*step)(const MigratingCell& cell, const OwnValues& values) = nullptr;
};

/// The laws that Morula brings, the default first.
std::vector<std::shared_ptr<const MigrationLaw>> migration_laws();
std::shared_ptr<const MigrationLaw> persistent_walk();

/// The key of the time over which a walk remembers its direction, P [s].
OwnKey persistence_key();

/// The values of persistent_walk that a study has which says nothing of them.
OwnValues usual_walk();

/// How cells of a type move by themselves.
struct Migration {
  double speed = 0.0;  ///< S, root mean square in three dimensions; 0: they do not [µm/s]
  int substrate = -1;  ///< material that must be touched, to which the force is tangential; -1: none
  std::shared_ptr<const MigrationLaw> law = persistent_walk();
  OwnValues own = usual_walk();  ///< of the law's own keys

  [[nodiscard]] bool acts() const { return speed > 0.0; }
  /// Number of the field that its cells sense, or −1.
  [[nodiscard]] int sensed_field() const { return acts() && law->senses_field ? own.number("field") : -1; }
};

}  // namespace morula
