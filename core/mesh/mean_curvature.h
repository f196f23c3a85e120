#pragma once
#include <numbers>
#include <span>

#include "core/mesh/triangle_mesh.h"
#include "core/vec3.h"

namespace morula {

/// M = ½ Σ l θ over the edges of a surface that two faces share, θ the angle between their outward normals, taken positive; faces without area do not count [µm].
double mean_curvature(std::span<const Vec3d> position, std::span<const Triangle> faces);

/// Volume within a distance d outside of a convex body: A d + M d² + 4/3 π d³ (Steiner 1840) [µm³].
inline double layer_around(double area, double mean_curvature, double d) {
  return d * (area + d * (mean_curvature + d * 4.0 / 3.0 * std::numbers::pi));
}

}  // namespace morula
