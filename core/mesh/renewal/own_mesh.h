#pragma once
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/mesh/renewal/change_guard.h"
#include "core/mesh/renewal/renew_surface.h"

namespace morula {

/// What a mesh of a shell's own is to be.
struct OwnMeshLimits {
  std::uint32_t nodes = 162;  ///< that edges would have if they were equally long everywhere
  double least_nodes = 0.7;   ///< of these
  double most_nodes = 1.5;    ///< of these
  double finest = 0.6;        ///< least part of that edge where the surface is curved strongly
  double area_change = 1e-4;  ///< of a pass, of the area, either way
  double off_surface = 0.02;  ///< of a node, beyond the chord error, in edges
};

/// What a pass has done and what it could not do.
struct OwnMeshReport {
  std::uint32_t splits = 0, collapses = 0, flips = 0, slides = 0;
  std::array<std::uint32_t, kChangeRefusals> refused{};  ///< changes that were wanted and not made, by ChangeRefusal, in the last round
  double least_quality = 0.0;                            ///< of the worst face
  double least_angle = 0.0;                              ///< of all faces [rad]
  double mean_edge = 0.0;                                ///< side of an equilateral triangle of the mean face area [µm]
  double area_change = 0.0;                              ///< relative to the surface
  double volume_error = 0.0;                             ///< relative to the surface
  SurfaceDistance distance;                              ///< from: surface to mesh; to: mesh to surface [µm]
  double off_surface = 0.0;                              ///< farthest node from the surface [µm]

  [[nodiscard]] std::uint32_t changes() const { return splits + collapses + flips + slides; }
  [[nodiscard]] std::uint32_t skipped() const;
};

/// A mesh with connectivity of its own.
struct OwnMesh {
  std::shared_ptr<const Topology> topology;
  std::vector<Vec3d> position;  ///< by node [µm]
  OwnMeshReport report;
};

/// One pass of local changes towards an even mesh with connectivity of its own: edges longer than 4/3 of the wanted length are split, ones shorter than 4/5
/// of it are drawn together (Botsch & Kobbelt 2004, doi:10.1145/1057432.1057457; dcm.md §14), edges are turned and nodes slide along the surface where
/// that lowers Σ f² over the faces around them, f = (1/q) (A/A0 + A0/A)/2 with the quality q and the wanted area A0. The wanted length is that of a mesh of
/// `nodes` even triangles, less where the surface is curved strongly, 0.3/|H| (dcm.md §14), with H the mean curvature, but at least `finest` of it.
///
/// Each change keeps the volume to rounding and is made only if a ChangeGuard has nothing against it: within the area that a pass may change,
/// the surface, the neighbours. What cannot be done is left and counted; the next pass may do more. Nodes come in the order of
/// with_near_neighbour_order(). A function of its arguments alone; the order of neighbours does not matter.
///
/// Error (kPhysics): nothing could be changed. Error (kInput): the surface encloses no volume.
Result<OwnMesh> renew_connectivity(const SurfaceView& surface, std::span<const SurfaceView> neighbours, const OwnMeshLimits& limits);

/// Least angle of all faces [rad].
double least_angle(std::span<const Triangle> faces, std::span<const Vec3d> position);

}  // namespace morula
