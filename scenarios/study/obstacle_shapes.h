#pragma once
#include "core/mesh/triangle_mesh.h"

namespace morula::scenarios {

// Closed meshes in µm, faces counter-clockwise seen from outside.

/// A box along the axes.
TriangleMesh box_surface(const Vec3d& center, const Vec3d& size);
/// A square slab whose upper face is centred at `center`, looks along `normal` (any length but 0) and has edges `size`; `size`/10 thick.
TriangleMesh slab_surface(const Vec3d& center, const Vec3d& normal, double size);
/// A sphere: the icosphere with 2562 nodes, scaled so that the enclosed volume is exact.
TriangleMesh sphere_surface(const Vec3d& center, double radius);
/// A solid cylinder between two points, with 64 sides whose cross-section has the circle's area.
TriangleMesh cylinder_surface(const Vec3d& from, const Vec3d& to, double radius);
/// A cylinder with round ends around two points, 64 sides.
TriangleMesh capsule_surface(const Vec3d& from, const Vec3d& to, double radius);

}  // namespace morula::scenarios
