#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/mesh/renewal/cut_halves.h"
#include "core/mesh/renewal/renew_surface.h"

namespace morula {

/// What a surface is cut into.
struct DivisionPlan {
  Vec3d normal = {};                      ///< of the plane; need not be a unit vector
  double share = 0.5;                     ///< part of the volume on the side to which the normal points, 0.1 to 0.9
  const ReferenceShape* shape = nullptr;  ///< connectivity of the daughters: a shape like a ball, whose nodes lie in different directions
  std::span<const SurfaceView> neighbours = {};  ///< surfaces that daughters shall stay out of; their order does not matter
  RenewalLimits limits = {};
};

/// A daughter on the connectivity asked for.
struct Daughter {
  std::vector<Vec3d> position;  ///< by node [µm]
  RenewalReport report;         ///< against its half of the cut surface
  double rim_rms = 0.0;         ///< root mean squared distance of the rim's points from the mesh [µm]
  double rim_largest = 0.0;     ///< [µm]
  std::vector<char> is_cap;     ///< by face: whether it belongs to the new interface (transfer_marks())
};

/// Both daughters; the first lies on the side to which the normal points.
struct Division {
  std::array<Daughter, 2> daughter;
  CutHalves cut;                    ///< the exact halves: what daughters are measured against, and where marks come from
  std::vector<AskedSurface> asked;  ///< the surfaces of both halves
};

/// Map a closed half onto a connectivity: two-disk map, evening-out, fit with walls, volume; the ways of the ladder one after the other
/// until one is within the limits. Error (kPhysics): none is; then the half needs connectivity of its own, or another plane.
Result<Daughter> map_half(const ClosedHalf& half, const AskedSurface& surface, std::span<const AskedSurface* const> walls,
                          const ReferenceShape& shape, double volume, const RenewalLimits& limits);

/// Division by cut: the surface is cut by the plane above which lies `share` of its volume, both halves are closed by the same cap in
/// opposite orientation and mapped onto the connectivity of `shape`. The volumes of the daughters are their shares to 10⁻¹². Daughters stay
/// out of each other's half. The same bits whatever the order of the neighbours.
///
/// Errors: those of cut_in_two() and map_half(), which names the daughter.
Result<Division> divide_surface(const SurfaceView& surface, const DivisionPlan& plan);

}  // namespace morula
