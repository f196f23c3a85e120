#pragma once
#include <span>
#include <vector>

#include "core/parallel/comm.h"
#include "coupling/events.h"
#include "coupling/swaps.h"

namespace morula {

/// How long after an exchange of bodies its neighbours are looked at again: about ten mechanical relaxation times [s].
inline constexpr double kExchangeSettles = 600.0;

/// Neighbours that keep their bodies while others exchange theirs, as they are just before.
struct ExchangeWatch {
  /// A cell of this rank that is beside one that exchanges its body: nearer than 1.2 times their radii as balls.
  struct Beside {
    CellId exchanged, neighbour;
    Vec3d place;          ///< [µm]
    double radius = 0.0;  ///< as a ball [µm]
    Vec3d force;          ///< that all terms put on it [nN]
  };
  std::vector<Beside> beside;
};

/// `center`: of the cells, by row; `orders`: of this rank. Collective.
ExchangeWatch watch_exchanges(const Model& model, const Tissue& tissue, std::span<const Vec3d> center, std::span<const SwapOrder> orders,
                              Mechanics& mechanics, const Comm& comm);

/// The bodies have been exchanged, and nobody has moved: the events of this rank learn what this did to the forces on the neighbours, and the tissue
/// whose ways are to be told later. Collective.
void tell_exchanges(const ExchangeWatch& watch, Tissue& tissue, Mechanics& mechanics, const Comm& comm, std::vector<Event>& events);

}  // namespace morula
