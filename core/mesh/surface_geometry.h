#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/lane_blocks.h"
#include "core/mesh/topology.h"
#include "core/vec3.h"

namespace morula {

/// Closed triangulated surfaces, ghosts included: where the nodes and faces of each of them start in the node and face arrays.
struct SurfaceList {
  std::span<const Topology* const> topology;  ///< by surface
  std::span<const std::uint32_t> first_node;  ///< by surface, at least as many entries
  std::span<const std::uint32_t> first_face;  ///< by surface, one more at the end
  int threads = 1;                            ///< that work on them; results do not depend on it
};

/// Areas, normals and volumes at some positions. Node arrays are indexed as the positions; a position that belongs to no surface (the
/// centre of a sphere) has zeros.
struct SurfaceGeometry {
  std::vector<double> face_area;           ///< A_T [µm²]
  std::vector<Vec3d> face_normal;          ///< n_T: unit, outward
  std::vector<Vec3d> node_normal;          ///< n_v: unit, the direction of Σ_T A_T n_T over the faces around the node
  std::vector<double> node_normal_length;  ///< |Σ_T A_T n_T| [µm²]
  std::vector<double> node_area;           ///< a_v: a third of the areas around the node [µm²]
  std::vector<double> volume, area;        ///< by surface: enclosed volume [µm³], total area [µm²]
};

/// Geometry of all surfaces at `position`, in lanes over surfaces of one Topology, in parallel over blocks; the same bits for every
/// grouping and any number of threads. A face without area gives a normal that is not a number (dcm::internal_forces reports it).
void compute_surface_geometry(const SurfaceList& surfaces, std::span<const LaneBlock> blocks, std::span<const Vec3d> position,
                              SurfaceGeometry& geometry);
/// The same; groups the surfaces itself.
void compute_surface_geometry(const SurfaceList& surfaces, std::span<const Vec3d> position, SurfaceGeometry& geometry);
/// The same without the arrays by face, which are emptied: what a tissue needs of them is cheaper to find again than to keep.
void compute_node_geometry(const SurfaceList& surfaces, std::span<const Vec3d> position, SurfaceGeometry& geometry);

/// Derivatives of an energy that depends on areas and normals of surfaces.
struct SurfaceGradient {
  std::span<const double> face_area;   ///< ∂E/∂A_T by face [nN/µm]
  std::span<const Vec3d> face_normal;  ///< ∂E/∂n_T by face [nN·µm]; empty: zero
  std::span<const Vec3d> node_normal;  ///< ∂E/∂n_v by node [nN·µm]
};

/// Add −∂E/∂x to the forces of the nodes of all surfaces, by the chain rule through A_T, n_T and n_v:
///
/// with G_v = Σ_T A_T n_T,  ∂E/∂G_v = (I − n_v n_vᵀ) ∂E/∂n_v / |G_v|,
/// w_T = ½ Σ_{v∈T} ∂E/∂G_v + ½ n_T ∂E/∂A_T + (I − n_T n_Tᵀ) ∂E/∂n_T / (2 A_T),  F_c −= w_T × e_c with e_c the edge opposite to corner c
/// (∂A/∂x_c = ½ n × e_c: dcm.md §4). Net force and torque vanish when the gradient is that of an energy invariant under rigid motion.
///
/// `geometry` is that of `position`; its arrays by face are not read.
void add_surface_forces(const SurfaceList& surfaces, std::span<const LaneBlock> blocks, std::span<const Vec3d> position,
                        const SurfaceGeometry& geometry, const SurfaceGradient& gradient, std::span<Vec3d> force);
/// The same; groups the surfaces itself.
void add_surface_forces(const SurfaceList& surfaces, std::span<const Vec3d> position, const SurfaceGeometry& geometry,
                        const SurfaceGradient& gradient, std::span<Vec3d> force);

}  // namespace morula
