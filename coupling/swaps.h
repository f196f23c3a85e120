#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/parallel/comm.h"
#include "coupling/cell_record.h"
#include "coupling/cell_view.h"
#include "coupling/events.h"
#include "coupling/mechanics/mechanics.h"
#include "coupling/tissue.h"

namespace morula {

/// Who goes first where not all can exchange their bodies: cells of the rule that stands first in the study (regions before triggers; none comes last),
/// among them those furthest beyond its threshold, among these the lowest ids.
struct Urgency {
  std::uint64_t rule = 0;
  double beyond = 0.0;  ///< how deep within a region [µm], how far beyond a trigger's threshold [its unit]
  CellId id;

  friend bool operator<(const Urgency& a, const Urgency& b) {
    if (a.rule != b.rule) return a.rule < b.rule;
    return a.beyond != b.beyond ? a.beyond > b.beyond : a.id < b.id;
  }
};

/// A cell that is to exchange its body.
struct SwapOrder {
  std::size_t row = 0;
  BodyKind to = BodyKind::kShell;
  EventReason reason;
  Urgency urgency{};
};

/// What regions and triggers see of the bodies of a rank.
struct SwapBodies {
  std::span<const Vec3d> center;       ///< of the cells, by row [µm]
  const BodyValues* values = nullptr;  ///< where triggers look at them (look_at_bodies())
  const AsBalls* balls = nullptr;      ///< likewise
  /// By region that counts contacts and row: how many the cell is away; empty for all other regions, and where nobody has counted.
  std::span<const std::vector<std::uint32_t>> contacts{};

  [[nodiscard]] CellView view(const Model& model, const Tissue& tissue, const BodyOfRow& body) const;
};

/// Whether a trigger needs SwapBodies::values and SwapBodies::balls.
bool look_at_bodies(const Swaps& swaps);

/// What regions and triggers look at of the bodies of a rank at present positions; nothing where none does.
struct LookedAt {
  std::optional<BodyValues> values;
  std::optional<AsBalls> balls;
  std::vector<std::vector<std::uint32_t>> contacts;

  [[nodiscard]] SwapBodies bodies(std::span<const Vec3d> center) const {
    return {center, values ? &*values : nullptr, balls ? &*balls : nullptr, contacts};
  }
};
/// `center`: of the cells, by row. Collective.
LookedAt look_for_swaps(const Model& model, const Tissue& tissue, std::span<const Vec3d> center, Mechanics& mechanics, const Comm& comm);

/// Which cells exchange their body now, by regions and triggers with their margins, thresholds and hold times. Decisions read only the state
/// given here: rows, and their bodies. Among the willing the most urgent come first; not more than max_shells shells,
/// not more than one in a hundred cells (at least one) a step once the run has begun (fields_and_coupling.md, D). By row. Collective.
std::vector<SwapOrder> choose_swaps(const Model& model, const Tissue& tissue, const SwapBodies& bodies, const Comm& comm);

/// Whether the ball of a cell would be packed more tightly than the law of its type's spheres goes: such a shell stays one. caps: what the ball loses
/// behind the planes of its contacts, AsBalls::caps [µm³].
bool is_too_tight_for_a_sphere(const CellRow& row, const CellType& type, double caps);

/// Whether any cell is to exchange its body as soon as its hold time is over, or when it is its turn. caps: of all cells (AsBalls::caps); empty where no
/// type's law of spheres ends at a packing. Collective.
bool swaps_wait(const Model& model, const Tissue& tissue, const SwapBodies& bodies, std::span<const double> caps, const Comm& comm);

/// What a pressure [kPa] leaves of the ball V of a cell of this type that becomes a shell: V exp(−p/K_V), half of it at least; the ball itself
/// where the cell follows its water, whose amount is the ball (decision 0076) [µm³].
double volume_under_pressure(double ball, double pressure, const CellType& type);
/// The sphere becomes a shell of volume_under_pressure(), its mesh a sphere in the orientation that the seed gives to its id, so that no direction of
/// the lattice is common to the shells of a tissue. V0 is that of the free cell whose volume is the ball: its inner pressure bears `pressure` (negative:
/// tension) and the cortex. Of the volume `left_out` is missing at first [µm³], but half of the ball it has in any case; gives the part of the free volume
/// that is still to come as the cell eases to its own [µm³].
double promote(CellRecord& cell, const CellType& type, double pressure, double time, ShapeLibrary& shapes, std::uint32_t seed,
               double left_out = 0.0);
/// The shell becomes a sphere at its centroid: of the volume that it has when nothing presses it, for a sphere that is pressed overlaps its
/// neighbours; of the shell's own volume where the cell follows its water (decision 0076).
void demote(CellRecord& cell, const CellType& type, double time);

/// The ids of all ranks, sorted. Collective.
std::vector<CellId> ids_of_all_ranks(const std::vector<CellId>& mine, const Comm& comm);

/// Spheres among the cells adhere to what they touch: `touching` are pairs (cell, partner), sorted, as Mechanics::touching gives them. An attached
/// pair is listed with both; partners that are shells are forgotten at the next step.
void attach_touching(std::span<CellRecord> cells, std::span<const std::pair<CellId, CellId>> touching);
void attach_touching(Tissue& tissue, std::span<const std::pair<CellId, CellId>> touching);

/// V0 of a free shell of this target volume: V exp(2γ/(R K_V)) [µm³]. `deviation`: of γ from that of the type, as a part of it.
double free_reference_volume(double target_volume, const CellType& type, double deviation);

}  // namespace morula
