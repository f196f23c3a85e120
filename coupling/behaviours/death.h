#pragma once
#include <cstdint>

#include "coupling/cells.h"
#include "coupling/model.h"

namespace morula {

/// Let a dying cell shrink for dt [s]: V = V_0 e^(−t/τ_a).
void shrink(CellRow& row, const CellType& type, double dt);

/// Whether a cell that began to die at death_time [s] is below removal_fraction of its volume then, which follows from the time since.
bool is_gone(double death_time, const CellType& type, double time);

}  // namespace morula
