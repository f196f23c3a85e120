#pragma once
#include <cstdint>

#include "core/vec3.h"
#include "coupling/cells.h"
#include "coupling/model.h"

namespace morula {

/// Persistent random walk as an Ornstein–Uhlenbeck process of the wanted velocity u (Uhlenbeck & Ornstein 1930,
/// doi:10.1103/PhysRev.36.823): du = −u dt/P + σ√(2/P) dB per component, σ = S/√3, so that ⟨|u|²⟩ = S² and
/// MSD(t) = 2S²P[t − P(1 − e^(−t/P))]. S: migration_speed, P: migration_persistence of the type.

/// u after a step of dt [s], exactly: u ← ρu + σ√(1 − ρ²) ξ, ρ = e^(−dt/P). ξ is that of (cell, step). 0 where the speed is 0.
Vec3d next_migration_velocity(const Vec3d& velocity, CellId cell, const CellType& type, std::uint32_t seed, std::uint64_t step, double dt);

/// u of a new founder: from the stationary law, a normal vector of σ per component.
Vec3d initial_migration_velocity(CellId cell, const CellType& type, std::uint32_t seed);

/// Friction of an isolated cell with the medium, Γ_cm = γ_med·4πR² with R the radius of a sphere of this volume [nN·s/µm].
/// friction: γ_med [nN·s/µm³]; volume [µm³].
double medium_friction_of(double friction, double volume);

/// F = Γ_cm u: the force under which the isolated cell moves with its wanted velocity u [nN]. volume: of the body [µm³].
Vec3d migration_force(const Vec3d& wanted, const CellType& type, double volume);

}  // namespace morula
