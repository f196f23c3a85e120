#pragma once
#include <span>
#include <vector>

#include "core/parallel/comm.h"
#include "coupling/events.h"
#include "coupling/neighbourhoods.h"
#include "coupling/swaps.h"

namespace morula {

/// How long after an exchange of bodies its neighbours are looked at again: about ten mechanical relaxation times [s].
inline constexpr double kExchangeSettles = 600.0;

/// Cells that are to exchange their bodies and their neighbours, which keep theirs, as they are just before.
struct ExchangeWatch {
  /// A cell that exchanges its body.
  struct Exchanging {
    CellId id;
    Vec3d place;                ///< [µm]
    double radius = 0.0;        ///< as a ball [µm]
    double caps = 0.0;          ///< what its ball loses behind the planes of its contacts [µm³]
    double among_shells = 0.0;  ///< of a new shell: caps with what are shells after the exchange, as balls [µm³]
  };
  /// A neighbour of a cell that exchanges its body: nearer than 1.2 times their radii as balls.
  struct Beside {
    CellId exchanged, neighbour;
    Vec3d place;          ///< [µm]
    double radius = 0.0;  ///< as a ball [µm]
    Vec3d force;          ///< that all in the neighbourhood put on it [nN]
  };
  std::vector<Neighbourhood> around;
  std::vector<Exchanging> exchanging;  ///< of all ranks, by id
  std::vector<Beside> beside;          ///< of the neighbourhoods that this rank looks at

  [[nodiscard]] double caps_of(CellId id) const;
  /// How far a cell is from there, over its radius.
  [[nodiscard]] double way_of(CellId id, const Vec3d& to) const;
  /// What a new shell begins without: its caps among shells beyond `pressed`, what its pressure takes of its ball (decisions 0059, 0076) [µm³].
  [[nodiscard]] double room_to_come_of(CellId id, double pressed) const;

 private:
  [[nodiscard]] Exchanging of(CellId id) const;
};

/// Looks at the neighbourhoods of these orders alone. Collective.
ExchangeWatch watch_exchanges(const Model& model, const Tissue& tissue, std::span<const SwapOrder> orders, const Mechanics& mechanics,
                              ShapeLibrary& shapes, const Comm& comm);

/// The bodies have been exchanged, nobody else has moved, and no cell has come or gone: the events of this rank learn how far their cells went and what this
/// did to the forces on the neighbours, and the tissue whose ways are to be told later. Collective.
void tell_exchanges(const ExchangeWatch& watch, Tissue& tissue, const Mechanics& mechanics, ShapeLibrary& shapes, const Comm& comm,
                    std::vector<Event>& events);

}  // namespace morula
