#pragma once
#include "core/mesh/triangle_mesh.h"
#include "core/result.h"

namespace morula {

/// Triangulated simple bodies, centred at the origin, in near-neighbour order (node_order.h). Lengths in µm. Nodes lie on the ideal surface, so that
/// curved ones enclose a little less. `edge` is an upper mark for the edge length along the main directions (diagonals are longer).
/// All are closed with outward faces, the plane excepted. Errors: a length that is not positive and finite, or more than 10⁷ faces.

/// Rectangle size_x × size_y in the plane z = 0, open, normal +z.
Result<TriangleMesh> make_plane(double size_x, double size_y, double edge);
/// Icosphere with 10·4^level + 2 nodes, level 0 to 9.
Result<TriangleMesh> make_sphere(double radius, int level);
/// Box with these side lengths.
Result<TriangleMesh> make_box(const Vec3d& size, double edge);
/// Cylinder around z with flat ends; `length` from end to end.
Result<TriangleMesh> make_cylinder(double radius, double length, double edge);
/// Cylinder around z with hemispheres at its ends; `length` from pole to pole, at least 2 × radius (equal: a sphere).
Result<TriangleMesh> make_capsule(double radius, double length, double edge);

}  // namespace morula
