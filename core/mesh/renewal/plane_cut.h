#pragma once
#include <cstdint>
#include <vector>

#include "core/mesh/renewal/surface_view.h"
#include "core/mesh/triangle_mesh.h"
#include "core/result.h"

namespace morula {

/// What lies on one side of a cut, as an open mesh: the nodes of the surface on this side in increasing order of their old numbers, then
/// the nodes of the rim in the order of PlaneCut::rim.
struct OpenHalf {
  TriangleMesh mesh;
  std::uint32_t first_rim_node = 0;
  std::vector<std::uint32_t> source_face;  ///< by face: the face of the surface that it is (a part of)
};

/// A closed surface cut in two by the plane x·normal = offset.
struct PlaneCut {
  Vec3d normal;            ///< unit
  double offset = 0.0;     ///< [µm]
  std::vector<Vec3d> rim;  ///< one closed line, counter-clockwise about the normal, without repetition
  OpenHalf above, below;   ///< above: on the side to which the normal points
};

/// Cut a closed surface by the plane with this normal above which lies `share` of the enclosed volume.
///
/// The volume below a plane is the sum of the signed tetrahedra over what lies below of each face, with their common apex in the plane, so
/// that the cap adds nothing; the plane is found by bracketed secant steps on it. Nodes nearer to the plane than 10⁻⁶ mean edges count as
/// above it by that much, so that no edge is cut at its end; both halves use the same points. The rim may therefore stand off the plane by
/// 2·10⁻⁶ mean edges, and the volumes of the closed halves are their shares to about that accuracy; their sum is exact to rounding.
///
/// Errors (kInput): a normal without length, a share outside 0.1–0.9, coordinates that are not finite, a surface without positive volume;
/// (kPhysics): the plane meets the surface in more than one closed line (a dumbbell cut lengthwise, a bowl).
Result<PlaneCut> cut_by_plane(const SurfaceView& surface, const Vec3d& normal, double share);

}  // namespace morula
