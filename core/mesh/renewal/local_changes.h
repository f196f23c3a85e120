#pragma once
#include <optional>

#include "core/mesh/renewal/live_mesh.h"

namespace morula {

/// The local changes that renew a mesh. Each keeps the mesh closed, oriented and of its genus, and encloses the same volume to rounding. Whether the shape
/// bears it is for a ChangeGuard to say. Precondition of all: a and b are the ends of an edge.

/// A new node in the middle of an edge; the surface stays what it is.
MeshChange split_edge(const LiveMesh& mesh, std::uint32_t a, std::uint32_t b);

/// The edge between the other two corners of both faces in place of a–b; none where these have an edge already, or where a node would keep fewer than
/// three. The volume of the tetrahedron in between is given back by all four nodes, each along its ∂V/∂x.
std::optional<MeshChange> flip_edge(const LiveMesh& mesh, std::uint32_t a, std::uint32_t b);

/// Node b becomes one with a, at the place nearest to `wanted` [µm] at which the volume stays (one linear condition: Lindstrom & Turk 1998,
/// doi:10.1109/VISUAL.1998.745314). None where the ends have other common neighbours than the two corners opposite of the edge (the surface would be
/// pinched off: the link condition, Dey et al. 1999), or where one of these would keep fewer than three edges.
std::optional<MeshChange> collapse_edge(const LiveMesh& mesh, std::uint32_t a, std::uint32_t b, const Vec3d& wanted);

/// A node goes to the place nearest to `wanted` [µm] at which the volume stays: along the surface.
MeshChange slide_node(const LiveMesh& mesh, std::uint32_t node, const Vec3d& wanted);

/// How much more a change makes the mesh enclose; zero but for rounding for those above [µm³].
double volume_change(const LiveMesh& mesh, const MeshChange& change);

}  // namespace morula
