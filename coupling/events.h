#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "core/cell_id.h"

namespace morula {

struct Model;

enum class EventKind : std::uint8_t {
  kDivision,
  kDivisionWaits,  ///< a shell reached its division volume, and does not divide yet
  kDeath,
  kRemoval,
  kPromotion,
  kDemotion,
  kQuiescence,       ///< a cell left its cycle
  kReturn,           ///< and came back
  kExchangeSettled,  ///< how far the neighbours of a cell went since it exchanged its body (coupling/exchange_effects.h)
  kWarning,
};

/// Why something happened, as data: text_of() makes the words for it, where they are written.
struct EventReason {
  enum class Cause : std::uint8_t {
    kNone,
    kDivisionVolume,
    kDivisionVolumeAsShell,
    kLastPhase,    ///< the last phase of its cycle ended
    kPhaseHeld,    ///< the rate of a phase went below or above a threshold; `number`: of the cell's type
    kNoPlane,      ///< a shell that is to divide found no plane by which it can
    kUnevenMesh,   ///< a shell whose nodes cannot be spread evenly
    kLongLineage,  ///< it cannot divide once more
    kBehaviour,    ///< `number`: of the cell's type, + 2¹⁶ times that of the behaviour of the type
    kShrunk,
    kRegion,       ///< `number`: of the region, in Model::swaps
    kTrigger,      ///< `number`: of the trigger, in Model::swaps
    kOutside,      ///< of all regions and triggers
    kBecameShell,  ///< of kExchangeSettled: what the exchange was
    kBecameSphere,
  };
  Cause cause = Cause::kNone;
  bool no_room = false;  ///< it had become a shell and found no room among its neighbours
  std::uint32_t number = 0;
};

/// What an exchange of bodies did to the neighbours of the cell, which kept theirs (decision 0050).
struct ExchangeEffect {
  std::uint32_t neighbours = 0;
  bool became_shell = false;
  double volume = 0.0;  ///< of the body that the cell had [µm³]
  /// dV: how much more room the cell takes than before, which as a sphere has its ball without the caps behind the planes of its contacts, and as a shell the
  /// volume that its pressure leaves. Of promotions mostly > 0, of demotions < 0 [µm³].
  double room = 0.0;
  double later = 0.0;  ///< of its free volume, what a new shell among shells takes little by little (decision 0059) [µm³]
  /// How far the middle of the cell went while its new shell found its shape, over its radius: at once, its neighbours held.
  double own_way = 0.0;
  double largest_force = 0.0, mean_force = 0.0;  ///< change of the force on a neighbour before anyone has moved [nN]
  double largest_way = 0.0, mean_way = 0.0;      ///< of a neighbour from just before the exchange on, over its radius; of kExchangeSettled
};

/// Something that happened to a cell; written to events.jsonl, one line each, in the order of (time, kind, cell). Plain data: it travels
/// between ranks as it is.
struct Event {
  double time = 0.0;
  EventKind kind{};
  CellId cell;
  CellId first_daughter, second_daughter;
  EventReason reason;
  double volume = 0.0;                   ///< of a division: the mother's target volume [µm³]
  double birth_volume[2] = {0.0, 0.0};   ///< and those of her daughters at birth [µm³]
  std::uint16_t birth_type[2] = {0, 0};  ///< and what her daughters are
  /// Of a division by cut: how much the energy of the whole rose by the divisions of the same moment [nN·µm].
  std::optional<double> energy_rise{};
  /// Of an exchange of bodies in a run, and of what became of it.
  std::optional<ExchangeEffect> exchange{};
};

/// The reason, for people: "region core", "shrunk below the volume at which a dead cell is removed"; nothing for no cause.
[[nodiscard]] std::string text_of(const EventReason& reason, const Model& model);

}  // namespace morula
