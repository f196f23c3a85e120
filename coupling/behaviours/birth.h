#pragma once
#include <cstddef>
#include <cstdint>

#include "coupling/behaviours/phases.h"

namespace morula {

/// A cell of time 0.
///
/// Its radius at birth and its cycle duration are drawn from the type (streams kCellVariability and kDivisionDuration), its wanted
/// velocity from the stationary law. With random_age, a cell whose type cycles is at a random point of its cycle (balanced growth,
/// stream kInitialPhase) and has the target volume of that point; else it is at birth. All draws are keyed by the id,
/// so that a founder is the same in whatever order founders are made. Its variables are 0, but those of its phase (cycle_variables_of()) and those of its
/// traits.
CellState make_founder(CellId id, std::uint16_t type_index, const CellType& type, std::uint32_t seed, double time, bool random_age,
                       std::size_t cycle_variables = 0);

/// The row of a daughter without its variables (divide_variables()): what is copied is her mother's, and she begins a cycle of newly drawn
/// duration at `time` with the given birth volume; `place` is that of its beginning. `type`: the daughter's; `mothers_duration`: of the mother's cycle, as
/// long as it would have been in that type [s].
CellState make_daughter(const CellState& mother, int which, const CellType& type, std::uint32_t seed, double time, double birth_volume,
                        double mothers_duration, CyclePlace& place);

/// Puts a place in the cycle among the variables of a cell whose type has phases. `first`: number of the first of its variables.
void set_place(CellState& row, const CellType& type, const CyclePlace& place, std::size_t first);

/// Draws how far a cell is from its type in each trait, a daughter from what her mother is; the row has all its variables then.
void draw_traits(CellState& row, const CellType& type, std::uint32_t seed, const CellState* mother = nullptr);

}  // namespace morula
