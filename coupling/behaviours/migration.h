#pragma once
#include <cstdint>

#include "core/vec3.h"
#include "coupling/cells.h"
#include "coupling/model.h"

namespace morula {

/// A step of a cell by the law of its type. 0 where cells of the type do not migrate.
Walk migrate(const MigratingCell& cell, const CellType& type);

/// That of a new founder.
Vec3d initial_migration_velocity(CellId cell, const CellType& type, std::uint32_t seed);

/// Velocity with which a cell crawls where it is, relative to what it crawls on [µm/s]. In the open it is u. Where the cell touches an obstacle
/// (`touches`, with the normal of the contact) it is √(3/2) of the part of u along the surface, so that the root mean square of the speed is S there,
/// too, and the part of u across it. A walk that needs a substrate has nothing across it, and nothing where the cell does not touch it.
/// The force that belongs to it is Γ times this velocity, Γ all friction of the body with what stands still: Mechanics::add_crawling().
Vec3d crawling_velocity(const Vec3d& wanted, bool touches, const Vec3d& normal, bool needs_substrate);

}  // namespace morula
