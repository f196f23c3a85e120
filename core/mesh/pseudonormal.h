#pragma once
#include <span>

#include "core/mesh/closest_point.h"
#include "core/mesh/topology.h"

namespace morula {

/// Unit outward normal of a face; zero for a face without area.
Vec3d unit_face_normal(const Triangle& face, std::span<const Vec3d> position);

/// Angle of a face at its corner 0, 1 or 2 [rad]; zero where an edge has no length.
double corner_angle(const Triangle& face, int corner, std::span<const Vec3d> position);

/// Which corner of a face this node of it is: 0, 1 or 2.
inline int corner_of(const Triangle& face, std::uint32_t node) { return face[0] == node ? 0 : face[1] == node ? 1 : 2; }

/// Angle by which a surface turns across an edge, from its left face to its right one along its direction: 0 flat, > 0 convex [rad]. Normals of any lengths.
double turning_angle(const Vec3d& left_normal, const Vec3d& right_normal, const Vec3d& along);

/// A vector on the outer side of a feature of a face: the face's normal, the sum of both faces' unit normals at an edge, and at a node the sum
/// of the faces' unit normals weighted by their angles. A point whose nearest point on the surface lies on that feature is outside exactly
/// when its offset from there has a positive component along this vector (Bærentzen & Aanæs 2005, doi:10.1109/TVCG.2005.49). Not normalised.
Vec3d pseudonormal(const Topology& topology, std::span<const Vec3d> position, std::uint32_t face, TriangleFeature feature);

/// Distance of p from the surface, negative inside, given the nearest face and the nearest point on it [µm].
double signed_distance(const Topology& topology, std::span<const Vec3d> position, const Vec3d& p, std::uint32_t face,
                       const ClosestPoint& closest);

}  // namespace morula
