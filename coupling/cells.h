#pragma once
#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "core/cell_id.h"
#include "core/vec3.h"
#include "coupling/model.h"

namespace morula {

inline constexpr std::size_t kMaxFields = 4;

enum class Phase : std::uint8_t {
  kGrowing,  ///< between birth and division
  kWaiting,  ///< a shell at its division volume; announced once
  kResting,  ///< its type does not cycle
  kDying,    ///< shrinks until it is removed
};

/// One cell: everything biological, whatever its body. Plain bytes, so that it moves between ranks and into a checkpoint as it is.
struct CellRow {
  CellId id;
  CellId parent;
  std::uint64_t order = 0;         ///< place along the space-filling curve: the canonical order of cells is (order, id)
  double birth_time = 0.0;         ///< [s]
  double birth_volume = 0.0;       ///< [µm³]
  double target_volume = 0.0;      ///< what growth drives; the free volume of the body [µm³]
  double division_volume = 0.0;    ///< [µm³]
  double cycle_duration = 0.0;     ///< of this cell [s]
  double pressure = 0.0;           ///< averaged over the last minute [kPa]
  double death_time = -1.0;        ///< when it began to die, or -1 [s]
  double last_swap_time = -1e300;  ///< when its body was last exchanged [s]
  double reference_excess = 0.0;   ///< what is left of ln V0 beyond that of a free shell: eases after a swap, or follows the osmotic flux
  double inflation_left = 0.0;     ///< volume still to come of an inflating start [µm³]
  double inflation_rate = 0.0;     ///< [µm³/s]
  Vec3d polarity{};
  Vec3d migration_velocity{};                      ///< u of the persistent walk [µm/s]
  std::array<double, kMaxFields> amount{};         ///< taken from each field so far [amol]
  std::array<double, kMaxFields> concentration{};  ///< seen in each field [mM]
  std::uint64_t draws = 0;                         ///< rare events drawn so far: index of the next rare random number
  std::uint16_t type = 0;
  Phase phase = Phase::kGrowing;
  BodyKind body = BodyKind::kSphere;
  BodyKind own_body = BodyKind::kSphere;  ///< what it has outside all regions and below all triggers: as placed, or its mother's
  std::uint8_t unused_[3] = {};
};
static_assert(std::is_trivially_copyable_v<CellRow>);

/// Rows of a rank in canonical order (order, id). The k-th row with a shell owns the k-th shell, and likewise for spheres.
struct Cells {
  std::vector<CellRow> rows;

  [[nodiscard]] std::size_t size() const { return rows.size(); }
};

/// Canonical order: along the curve, ties by id.
inline bool before(const CellRow& a, const CellRow& b) { return a.order != b.order ? a.order < b.order : a.id < b.id; }

}  // namespace morula
