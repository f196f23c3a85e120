#pragma once
#include <cstdint>

#include "core/vec3.h"
#include "coupling/cells.h"
#include "coupling/model.h"

namespace morula {

/// Persistent random walk as an Ornstein–Uhlenbeck process of the wanted velocity u (Uhlenbeck & Ornstein 1930,
/// doi:10.1103/PhysRev.36.823): du = −u dt/P + σ√(2/P) dB per component, σ = S/√3, so that ⟨|u|²⟩ = S² and
/// MSD(t) = 2S²P[t − P(1 − e^(−t/P))]. S: migration_speed, P: migration_persistence of the type.

/// u after a step of dt [s], exactly: u ← ρu + σ√(1 − ρ²) ξ, ρ = e^(−dt/P). ξ is that of (cell, step). 0 where the speed is 0. σ is `factor` times that of the type.
Vec3d next_migration_velocity(const Vec3d& velocity, CellId cell, const CellType& type, std::uint32_t seed, std::uint64_t step, double dt,
                              double factor = 1.0);

/// u of a new founder: from the stationary law, a normal vector of σ per component.
Vec3d initial_migration_velocity(CellId cell, const CellType& type, std::uint32_t seed);

/// Velocity with which a cell crawls where it is, relative to what it crawls on [µm/s]. In the open it is u. Where the cell touches an obstacle
/// (`touches`, with the normal of the contact) it is √(3/2) of the part of u along the surface, so that the root mean square of the speed is S there,
/// too, and the part of u across it. A walk that needs a substrate has nothing across it, and nothing where the cell does not touch it.
/// The force that belongs to it is Γ times this velocity, Γ all friction of the body with what stands still: Mechanics::add_crawling().
Vec3d crawling_velocity(const Vec3d& wanted, bool touches, const Vec3d& normal, bool needs_substrate);

}  // namespace morula
