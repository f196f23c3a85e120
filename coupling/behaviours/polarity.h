#pragma once
#include <cstdint>

#include "core/cell_id.h"
#include "core/vec3.h"
#include "coupling/model.h"

namespace morula {

/// Polarity of a new founder: that of its type, or a random direction (stream kPolarity); 0 where the type has none.
Vec3d initial_polarity(CellId cell, const CellType& type, std::uint32_t seed);

/// Polarity after a step, by the rules of the type, one after the other.
Vec3d next_polarity(const Vec3d& polarity, const TurningCell& cell, const CellType& type);

}  // namespace morula
