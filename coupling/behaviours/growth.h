#pragma once
#include "coupling/cells.h"
#include "coupling/model.h"

namespace morula {

/// Target volume at a point of the cycle [µm³]: V_b (1 + a) for linear growth and V_b 2^a for exponential growth when the division
/// volume is 2 V_b; in general from birth_volume at a = 0 to division_volume at a = 1.
double volume_in_cycle(double birth_volume, double division_volume, bool exponential, double point);

struct Growth {
  bool reached = false;  ///< the division volume was reached in this step
  double late = 0.0;     ///< what was left of the step at that moment [s]
};

/// Let a cell grow for dt [s]: its target volume moves on by the law of its type over its own cycle duration, and stops at the division
/// volume. A cell whose averaged pressure (from outside: BodyValues) is above inhibit_pressure, and one whose type does not cycle, keeps its target volume.
/// Only the row itself is read.
Growth grow(CellRow& row, const CellType& type, double dt);

}  // namespace morula
