#pragma once
#include <cstdint>

#include "core/cell_id.h"
#include "core/vec3.h"
#include "coupling/model.h"

namespace morula {

/// Polarity of a new founder: that of its type, or a random direction (stream kPolarity); 0 where the type has none.
Vec3d initial_polarity(CellId cell, const CellType& type, std::uint32_t seed);

/// Polarity after a step of dt [s]: first rotational diffusion on the unit sphere, ⟨p(0)·p(t)⟩ = e^(−2 D_r t), in pieces of a variance
/// 2 D_r dt ≤ 0.02 each of which turns p along a great circle by a normal vector of its tangent plane; then the relaxation
/// dp/dt = (v̂ − p)/τ_p towards the direction of the velocity, exact for a constant one, and back to length 1. Random numbers are those of (cell, step).
Vec3d next_polarity(const Vec3d& polarity, const Vec3d& velocity, CellId cell, const CellType& type, std::uint32_t seed, std::uint64_t step,
                    double dt);

}  // namespace morula
