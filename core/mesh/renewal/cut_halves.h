#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/renewal/plane_cut.h"

namespace morula {

/// One half of a cut surface, closed by the cap. Nodes: those of the surface, then the rim, then those inside the cap. Faces: (parts of)
/// the surface's, then the cap's.
struct ClosedHalf {
  TriangleMesh mesh;
  std::uint32_t first_rim_node = 0, rim_nodes = 0;
  std::uint32_t first_cap_face = 0;
  std::vector<std::uint32_t> source_face;  ///< by face before the cap's: the face of the surface that it is (a part of)
  /// Whether the cap is on the lower side of the half: then the rim runs counter-clockwise about the old part seen from outside, else about
  /// the cap.
  bool above = false;
};

/// Triangulated cap of a flat rim: the rim's points are its nodes 0 to n − 1, the points inside follow.
struct Cap {
  std::vector<Vec3d> inner;     ///< [µm]
  std::vector<Triangle> faces;  ///< counter-clockwise about the normal
};

/// The cap of a rim that runs counter-clockwise about `normal`: points of a triangular lattice with this spacing that stay 0.45 of it away
/// from the rim, and a constrained Delaunay triangulation. Error (kPhysics): the rim crosses itself or encloses nothing.
Result<Cap> make_cap(std::span<const Vec3d> rim, const Vec3d& normal, double spacing);

/// Both closed halves, with the same cap in opposite orientation, so that their volumes add up to that of the surface to rounding.
struct CutHalves {
  std::array<ClosedHalf, 2> half;  ///< above, below
  std::vector<Vec3d> rim;          ///< [µm]
  double cap_area = 0.0;           ///< [µm²]
};

/// cut_by_plane() and make_cap(); errors as theirs.
Result<CutHalves> cut_in_two(const SurfaceView& surface, const Vec3d& normal, double share, double cap_spacing);

}  // namespace morula
