#pragma once
#include <span>
#include <vector>

#include "core/mesh/renewal/asked_surface.h"
#include "core/mesh/renewal/disk_map.h"

namespace morula {

/// What a renewed mesh must be. Quality alone does not tell: a mesh whose nodes have left a tip is even, and far from the surface.
struct RenewalLimits {
  double least_quality = 0.3;  ///< of the worst face
  double most_distance = 0.5;  ///< between old and new surface in either direction, in mean edges of the new mesh
};

/// How well a new mesh stands for a surface.
struct RenewalReport {
  double least_quality = 0.0;  ///< of the worst face
  double mean_edge = 0.0;      ///< side of an equilateral triangle of the mean face area [µm]
  SurfaceDistance distance;    ///< from: surface to mesh; to: mesh to surface [µm]
  double volume_error = 0.0;   ///< relative to the volume asked for
  double area_change = 0.0;    ///< relative to the surface
  bool crosses_itself = false;
  int rung = 0;  ///< which way of the ladder led to it, from 0
};

/// New positions of the nodes of a mesh, by node [µm], and how well they stand for the surface.
struct RenewedSurface {
  std::vector<Vec3d> position;
  RenewalReport report;
};

/// Measure a mesh against the surface it stands for and the volume it was asked for. The search for crossings, which is dear, is left out
/// when the mesh is beyond the limits already.
RenewalReport judge(const AskedSurface& surface, const Topology& topology, std::span<const Vec3d> position, double volume,
                    const RenewalLimits& limits);

/// Whether a mesh is within the limits, does not cross itself, and has its volume to 10⁻¹².
bool is_within(const RenewalReport& report, const RenewalLimits& limits);

/// One way to a mesh: how it is evened out and how fast nodes are held in the fit.
struct RenewalWay {
  double theta;               ///< of even_out()
  double tangential_hold;     ///< of FitOptions
  int steps = 6;              ///< of FitOptions
  double crease_width = 0.0;  ///< of FitOptions
};

/// Even out a mesh on the surface from these places, fit it, give it the volume, and measure it.
RenewedSurface renew_by(const AskedSurface& surface, std::span<const AskedSurface* const> walls, const Topology& topology,
                        std::vector<SurfacePlace> place, double volume, const RenewalWay& way, const RenewalLimits& limits);

/// The ways of a renewal one after the other until one is within the limits. `place`: where the nodes of the mesh begin on the surface; `walls`: their order does
/// not matter. Error (kPhysics): none is; `what` begins its message.
Result<RenewedSurface> renew_by_ladder(const AskedSurface& surface, std::span<const AskedSurface* const> walls, const Topology& topology,
                                       const std::vector<SurfacePlace>& place, double volume, const RenewalLimits& limits,
                                       const std::string& what);

/// An error (kPhysics) that tells what the best try misses.
Error no_mesh_holds(const std::string& what, const RenewalReport& best, const RenewalLimits& limits);

/// Redistribution: the nodes of a closed surface slide along it until its faces are even; connectivity and volume stay (volume to 10⁻¹²).
///
/// Ways are tried one after the other until one is within the limits. `neighbours`: surfaces that points of the new one are pulled out of;
/// their order does not matter. Error (kPhysics): no way leads to a mesh within the limits (tongues longer than 5 of their radii, narrow
/// necks); (kInput): no positive volume.
Result<RenewedSurface> redistribute(const SurfaceView& surface, std::span<const SurfaceView> neighbours = {},
                                    const RenewalLimits& limits = {});

}  // namespace morula
