#pragma once
#include <cstdint>

#include "coupling/cells.h"
#include "coupling/model.h"

namespace morula {

/// A cell of time 0.
///
/// Its radius at birth and its cycle duration are drawn from the type (streams kCellVariability and kDivisionDuration), its wanted
/// velocity from the stationary law. With random_age, a cell whose type cycles is at a random point of its cycle (balanced growth,
/// stream kInitialPhase) and has the target volume of that point; else it is at birth. Division volume is twice the birth volume. All draws are keyed by the id,
/// so that a founder is the same in whatever order founders are made. Its variables are 0.
CellState make_founder(CellId id, std::uint16_t type_index, const CellType& type, std::uint32_t seed, double time, bool random_age);

/// The row of a daughter without its variables (divide_variables()): what is copied is her mother's, and she begins a cycle of newly drawn
/// duration at `time` with the given birth volume.
CellState make_daughter(const CellState& mother, int which, const CellType& type, std::uint32_t seed, double time, double birth_volume);

}  // namespace morula
