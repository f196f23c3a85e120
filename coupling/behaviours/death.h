#pragma once
#include <cstdint>

#include "coupling/cells.h"
#include "coupling/model.h"

namespace morula {

/// Whether a cell begins to die in a step of dt [s]: a Poisson process of rate death_rate while the seen concentration `seen` of death_field [mM] is
/// below death_below, so with probability 1 − e^(−rate·dt). The random number is that of (cell, step).
bool begins_to_die(const CellRow& row, double seen, const CellType& type, std::uint32_t seed, std::uint64_t step, double dt);

/// Let a dying cell shrink for dt [s]: V = V_0 e^(−t/τ_a).
void shrink(CellRow& row, const CellType& type, double dt);

/// Whether a cell that began to die at death_time [s] is below removal_fraction of its volume then, which follows from the time since.
bool is_gone(double death_time, const CellType& type, double time);

}  // namespace morula
