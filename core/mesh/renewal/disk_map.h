#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/renewal/asked_surface.h"
#include "core/mesh/renewal/cut_halves.h"

namespace morula {

/// Where a node of a new mesh lies on a surface.
struct SurfacePlace {
  std::uint32_t face = 0;
  Vec3d point;  ///< [µm]
};

/// A closed half as a sphere: the old part above, the cap below, the rim between them.
///
/// Each of both is a disk with the same rim. It is mapped one to one to the unit disk by a Tutte embedding with mean-value weights (Floater
/// 2003, doi:10.1016/S0167-8396(03)00002-5), the rim on the circle by arc length. The distance from the middle becomes a polar angle such
/// that each of 24 rings has the share of the sphere's area that it has of the surface's.
class TwoDiskMap {
 public:
  explicit TwoDiskMap(const ClosedHalf& half);

  /// The point of the half that belongs to a direction. Precondition: |direction| = 1. The pole is the middle of the old part.
  [[nodiscard]] SurfacePlace at(const Vec3d& direction) const;

 private:
  static constexpr std::size_t kRings = 24;
  /// One of the two parts in the unit disk.
  struct Disk {
    std::uint32_t first_face = 0;
    double area = 0.0;               ///< [µm²]
    std::vector<double> area_below;  ///< share of the area within radius k / kRings, by k from 0 to kRings
    TriangleTree tree;               ///< of the mapped faces, in the plane z = 0
  };
  static Disk make_disk(const ClosedHalf& half, std::uint32_t first_face, std::uint32_t end_face, std::span<const double> rim_angle);

  TriangleMesh mesh_;
  Disk old_part_, cap_;
};

/// Places of the nodes of a mesh whose nodes lie in these directions from its middle. `tilt` (0, 1, ...) turns the directions: the pole
/// lies off the nodes, each tilt is another start of the same map.
std::vector<SurfacePlace> place_nodes(const TwoDiskMap& map, std::span<const Vec3d> direction, int tilt);

}  // namespace morula
