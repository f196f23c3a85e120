#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/surface_geometry.h"
#include "core/mesh/topology.h"

namespace morula {

/// How a surface bends in its two principal directions, κ > 0 where it bulges towards the side of its normals.
struct SurfaceCurvature {
  double mean = 0.0;      ///< (κ₁ + κ₂)/2 [1/µm]
  double gaussian = 0.0;  ///< κ₁ κ₂ [1/µm²]
  friend bool operator==(const SurfaceCurvature&, const SurfaceCurvature&) = default;
};

/// The curvature of the parts of a surface at the corners of each face; edges between two parts do not count.
///
/// ∫H dA of a face is a quarter of Σ length × angle over its edges: half of an edge's share, which is half of that (Steiner's formula of polyhedra). At a node
/// H is that of the faces of its part around it, which evens out how the mesh is laid, and K what the angles around it lack of 2π, over its Voronoi area (Meyer,
/// Desbrun, Schröder & Barr 2003, doi:10.1007/978-3-662-05105-4_2). At the rim of a part angles say nothing: it is taken to be bent in one direction there.
std::vector<std::array<SurfaceCurvature, 3>> curvature_of_parts(const Topology& topology, std::span<const Vec3d> position,
                                                                const SurfaceGeometry& geometry,
                                                                std::span<const std::uint32_t> part_of_face);

/// The normals of the parts of a surface at the corners of each face, of length 1: of the faces of its part around a node, with the weights A/(|a|² |b|²), a
/// and b their edges there, which are exact where the nodes lie on a ball (Max 1999, J. Graphics Tools 4(2), 1–6).
std::vector<std::array<Vec3d, 3>> normals_of_parts(const Topology& topology, std::span<const Vec3d> position,
                                                   const SurfaceGeometry& geometry, std::span<const std::uint32_t> part_of_face);

}  // namespace morula
