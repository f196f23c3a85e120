#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/vec3.h"
#include "coupling/cells.h"
#include "coupling/model.h"

namespace morula {

/// The rows of the two cells that a cell becomes.
struct DaughterRows {
  CellState first, second;
  double share = 0.5;  ///< of the first, of the mother's target volume
};

/// Divide the row of a cell, whatever its body, at an instant: V_1 = f V_m and V_2 = V_m − V_1, so that nothing is lost to rounding. Variables
/// are those of divide_variables().
///
/// `types`: those of the model; asked where the mother's type, which is `type`, has fates.
///
/// time: end of the step [s]; late: how long before that the division volume was reached [s]. The daughters are born at time − late, and
/// they have already gone through `late` of their cycles, freely; their bodies have not: the first step drives them there.
/// Precondition: mother.id.can_divide(), 0 < fraction < 1.
DaughterRows divide_row(const CellState& mother, std::span<const VariableColumn> variables, const CellType& type, std::uint32_t seed,
                        double time, double late, double fraction, std::span<const CellType> types = {});

/// What the two daughters of a cell become: drawn once from the fates of its type (stream kFate), however often the division is tried.
std::array<std::uint16_t, 2> fate_of(const CellState& mother, const CellType& type, std::uint32_t seed);

/// Place and size of a sphere.
struct SphereBody {
  Vec3d position;       ///< [µm]
  double radius = 0.0;  ///< [µm]
};

/// The bodies of the two cells that a sphere becomes.
struct SphereDivision {
  SphereBody first, second;
};

/// Divide a sphere along an axis of length 1. The daughters lie inside the mother's envelope, centres d apart at x + u d V_2/V_m and
/// x − u d V_1/V_m, which keeps the centroid; d = 0.4126 R_m for equal daughters (cbm/division_ramp.h, whose offset forgives their overlap
/// while it is released). Radii follow from the volumes: r = (V/V_m)^(1/3) R_m. share: V_1/V_m.
SphereDivision divide_sphere(const SphereBody& body, const Vec3d& axis, double share);

/// Give the daughters of a division, whose birth volumes are set, their variables as these declare it: what is shared goes by volume, the remainder
/// to the second.
void divide_variables(std::span<const VariableColumn> variables, const CellState& mother, CellState& first, CellState& second);

}  // namespace morula
