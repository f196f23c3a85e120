#pragma once
#include <cstdint>

#include "coupling/cells.h"
#include "coupling/model.h"

namespace morula {

/// How fast a cell grows by the law of its type. Where its birth volume alone decides at which volume it divides (timer), from that to its division
/// volume in its own cycle duration; else, so that small cells take longer, from the volume of its type's mean radius to `ratio` times that.
GrowthPace growth_pace(const CellRow& row, const CellType& type);

/// Volume at which a cell of this birth volume divides [µm³], after its type's control of size; stream kDivisionSize, keyed by the id.
double division_volume(const CellRow& row, const CellType& type, std::uint32_t seed);

/// Time that free growth takes from birth to division [s].
double time_to_grow(const CellRow& row, const CellType& type);

/// Target volume of a cell at a point of its growth, 0 at birth and 1 at division [µm³].
double volume_in_cycle(const CellRow& row, const CellType& type, double point);

/// Whether the averaged pressure (from outside: BodyValues) lets a cell grow at all.
[[nodiscard]] inline bool may_grow(const CellRow& row, const CellType& type) { return !(row.pressure > type.inhibit_pressure); }

struct Growth {
  bool reached = false;  ///< the division volume was reached in this step
  double late = 0.0;     ///< what was left of the step at that moment [s]
};

/// Let a cell grow for dt [s]: its target volume moves on by the law of its type at its pace, and stops at the division volume. A cell whose averaged
/// pressure is above inhibit_pressure, and one whose type does not cycle, keeps its target volume.
/// Only the row itself is read.
Growth grow(CellRow& row, const CellType& type, double dt);

}  // namespace morula
