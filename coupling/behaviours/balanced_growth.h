#pragma once
#include <cstdint>

#include "coupling/behaviours/phases.h"

namespace morula {

/// Rate at which the number of cells of a type grows in the end where nothing holds them back [1/s]: the α of Π E[e^(−α T_p)] = ½ over the phases
/// (Euler & Lotka; physics/cbm.md §5); ln 2 over the mean duration of a cycle without phases, or with phases that are parts of it. A phase that ends by
/// size is taken to last as long as it does in a cell of the size at which such a population settles.
double population_growth_rate(const CellType& type);

/// A cell of time 0 is given a place in its cycle, with the volume of that place, as if it were picked from a population in balanced growth (Powell 1956,
/// doi:10.1099/00221287-15-3-492): it is in phase p with probability 2 (1 − M_p) Π_{q<p} M_q, M = E[e^(−αT)]; the times of the phases behind it have
/// their law times e^(−αT), that of its own times 1 − e^(−αT), and the time since it began has the density e^(−αx). Numbers of the stream kInitialPhase.
/// Precondition: the row as begin_cycle() left it.
CyclePlace settle_in_balanced_growth(CellState& row, const CellType& type, std::uint32_t seed, double time);

/// A cell is given the place at which a part `point` of its own cycle has passed, with the volume of that place. Precondition: as above.
CyclePlace settle_at(CellState& row, const CellType& type, std::uint32_t seed, double time, double point);

}  // namespace morula
