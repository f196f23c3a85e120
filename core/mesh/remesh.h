#pragma once
#include <cstdint>

#include "core/mesh/triangle_mesh.h"
#include "core/result.h"

namespace morula {

/// How fine a surface is to be: exactly one of both is given.
struct RemeshTarget {
  std::uint32_t nodes = 0;  ///< about so many nodes
  double edge = 0.0;        ///< mean edge, about [µm]
};

/// A surface with even triangles.
struct Remeshed {
  TriangleMesh mesh;
  double mean_edge = 0.0;     ///< [µm]
  double volume_error = 0.0;  ///< relative change of the volume by the new triangles, before it was given back
};

/// Whether this build can remesh: the remesher is under GPL-3-or-later, and a build may leave it out (MORULA_WITH_GPL).
bool has_remesher();

/// The same closed surface with even triangles of the wanted size: edges are split, drawn together and turned, nodes are evened out and put back onto the
/// given surface (isotropic remeshing: Botsch & Kobbelt 2004, doi:10.1145/1057432.1057457; CGAL's Polygon Mesh Processing). Triangles cut off
/// what the surface bulges between their nodes: restore_volume() gives the volume back to 10⁻¹². With a wanted number of nodes the edge is tried
/// anew until the number is met within 2 %, or six times. The same result for the same mesh, whatever else runs.
///
/// Errors (kInput): the build has no remesher, the surface is not closed, the result would be (a part of) a surface that touches itself, or its volume changes by more than
/// 10 % before it is given back: the triangles are too large for this surface.
Result<Remeshed> remesh_surface(const TriangleMesh& mesh, const RemeshTarget& target);

/// Move nodes along their normals so that the closed surface encloses `volume`: in proportion to how far each node stands out of its neighbours' mean, so
/// that flat parts stay flat and caps bulge; what is left is scaled about the centroid. The sign and size of the bulge is that of the missing volume.
void restore_volume(TriangleMesh& mesh, double volume);

/// Side of a triangle in a mesh of even triangles with this many nodes and this area: A = (2N − 4) (√3/4) L². [µm]
double edge_of_nodes(double area, std::uint32_t nodes);

/// The same the other way round: nodes of a mesh of even triangles of this side.
double nodes_of_edge(double area, double edge);

/// Mean length of the edges of a closed surface [µm].
double mean_edge_length(const TriangleMesh& mesh);

/// Area of all faces [µm²].
double surface_area(const TriangleMesh& mesh);

}  // namespace morula
