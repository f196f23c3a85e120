#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "coupling/behaviours/growth.h"

namespace morula {

/// Where a cell is in the phases of its cycle: variables of the cells of models that have phases (cell_variables.h).
struct CyclePlace {
  std::size_t phase = 0;  ///< number of the phase; one more than the last: quiescent (G0)
  double left = 0.0;      ///< of the phase's time; 0 of one that ends by size [s]
  double held = 0.0;      ///< for how long what makes it leave the cycle, or come back, has held [s]
};

/// Whether cells grow from birth to division in the sum of the times of the phases in which they grow: no phase ends by size, and size is left to
/// the clock. Else their cycle duration is drawn from the type's.
bool paced_by_phases(const CellCycle& cycle);

/// Number of the last phase in which cells grow; that of none is the number of phases. It ends only when the division volume is reached, whatever
/// its clock says, so that cells that were held back do not become smaller and smaller.
std::size_t last_growing_phase(const CellCycle& cycle);

/// Time of a phase of a cell [s]: drawn by its id and the number of the phase from the stream kPhaseDuration, so that it is the same whenever it is
/// asked for. 0 of a phase that ends by size.
double phase_duration(const CellRow& row, const CellType& type, std::size_t phase, std::uint32_t seed);

/// The time of a phase [s] from the pairs of numbers `index`, `index` + 1, … of a stream; `index` is moved on. 0 of a phase whose time is not its own.
double draw_phase(const CyclePhase& phase, const Random& random, CellId cell, std::uint64_t& index);

/// The cycle of a cell of its own id, type and birth volume: its cycle duration and division volume, and its place at the beginning of its first phase.
/// A daughter's duration is drawn from her mother's. A type without phases has the usual place.
CyclePlace begin_cycle(CellState& row, const CellType& type, std::uint32_t seed, std::optional<double> mothers_duration = {});

/// Factor of the rate at which a phase passes, by its number.
using PhaseRate = std::function<double(std::size_t phase)>;

/// A step of dt [s] in the cycle of a cell whose type has phases: it grows at `growth` times its pace in the phases in which it grows, each phase passes
/// at its rate, and the next begins at the moment at which it ends. Growth::reached: its last phase ended in this step.
Growth pass_phases(CellRow& row, CyclePlace& place, const CellType& type, std::uint32_t seed, double dt, double growth,
                   const PhaseRate& rate);

enum class Leaving : std::uint8_t { kNo, kLeaves, kReturns };

/// Whether a cell leaves its cycle for quiescence or comes back at the start of a step of dt [s]; its place is changed. It comes back into the phase that it left,
/// with what was left of it.
Leaving leave_or_return(CyclePlace& place, const CellCycle& cycle, double dt, const PhaseRate& rate);

}  // namespace morula
