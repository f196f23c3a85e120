#pragma once
#include <span>
#include <vector>

#include "core/mesh/renewal/asked_surface.h"
#include "core/mesh/renewal/disk_map.h"

namespace morula {

/// Choices of a fit; the values are those of decision 0038.
struct FitOptions {
  double tangential_hold = 0.2;  ///< of the area of a node: keeps nodes where the even mesh has them
  int steps = 6;
  double crease_width = 0.0;  ///< in mean edges: how much area a sharp edge stands for; draws nodes into it at the cost of even faces
};

/// Fit a mesh to a surface in the sense of least squares, and give it a volume.
///
/// Each Gauss–Newton step minimises Σ w |p − y|²_K over points p of the mesh (six a face) with their nearest points y of the surface and
/// over samples y of the surface with their nearest points p of the mesh, K = (1 − μ) n nᵀ + μ I with the surface's normal n at y and μ =
/// 0.02, w the area a point stands for; plus a hold of each node of area a about its present place, a (0.02 I + tangential_hold (I − n
/// nᵀ)). With a crease_width, samples of edges at which the surface bends by more than 45° draw the mesh to the edge too. From the third
/// step on, points inside one of the `walls` are pulled to that wall's surface with thrice their weight (the deepest wall, whatever the
/// order of the list). No node moves more than 0.3 mean edges a step. At last V(x + t M⁻¹ ∂V) = volume is solved for t, M the matrix of the
/// last step: the volume comes from where the fit minds least.
///
/// `place` holds the nodes' places on the surface; the result are positions near it [µm]. A function of its arguments alone.
std::vector<Vec3d> fit_to_surface(const AskedSurface& surface, std::span<const AskedSurface* const> walls, const Topology& topology,
                                  std::span<const SurfacePlace> place, double volume, const FitOptions& options);

/// Move x along a direction until the closed mesh encloses `volume` to rounding; false when it cannot.
bool move_to_volume(std::span<const Triangle> faces, std::span<const Vec3d> direction, double volume, std::vector<Vec3d>& x);

/// ∂V/∂x of the enclosed volume, by node [µm²].
std::vector<Vec3d> volume_gradient(std::span<const Triangle> faces, std::span<const Vec3d> x);

}  // namespace morula
