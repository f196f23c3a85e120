#pragma once
#include <span>

#include "core/mesh/renewal/renew_surface.h"

namespace morula {

/// Root of the ratio of the largest to the second largest second moment of a surface about its middle: 1 for balls and plates, 2.57 for an ellipsoid
/// three times as long as wide.
double elongation(const SurfaceView& surface);

/// The nodes of a shape like a ball, such as an icosphere, on a surface with any connectivity: each begins where the ray from the centroid in its direction
/// leaves the surface for the last time, then all are evened out, fitted and given the volume as by redistribute().
///
/// Error (kInput): the surface encloses no volume. Error (kPhysics): the centroid lies outside, or no way leads to a mesh within the limits.
Result<RenewedSurface> onto_ball(const SurfaceView& surface, std::span<const SurfaceView> neighbours, const ReferenceShape& shape,
                                 const RenewalLimits& limits);

}  // namespace morula
