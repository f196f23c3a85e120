#pragma once
#include <numbers>

#include "core/ball.h"

namespace morula::cbm {

/// Caps of two overlapping spheres behind their radical plane, and how they change with the distance of the centres (cbm.md §3).
struct SphereCaps {
  double volume_a = 0.0, volume_b = 0.0;        ///< of sphere a behind the plane, of sphere b before it [µm³]
  double slope_a = 0.0, slope_b = 0.0;          ///< −dv/dd ≥ 0: the share of the disc that each side presses on [µm²]
  double curvature_a = 0.0, curvature_b = 0.0;  ///< d²v/dd² [µm]
};

/// The caps of spheres of radius a and b [µm] at a distance of their centres [µm].
///
/// The plane lies at l_a = (d² + R_a² − R_b²)/(2d) from a and l_b = d − l_a from b, and cuts out a disc of radius² a_g² = R_a² − l_a². With
/// h = R − l: v = πh²(3R − h)/3, dv_a/dd = −πa_g² l_b/d, dv_b/dd = −πa_g² l_a/d (cbm.md §3: l_b/d = ½(1 − (R_a² − R_b²)/d²)).
/// Apart: nothing. One within the other: all of the smaller one and nothing of the larger, whatever the distance.
constexpr SphereCaps sphere_caps(double a, double b, double distance) noexcept {
  SphereCaps out;
  if (distance >= a + b) return out;
  const double shift = (a - b) * (a + b);
  if (distance * distance <= (a - b) * (a - b)) {
    if (a <= b) out.volume_a = ball_volume(a);
    if (b <= a) out.volume_b = ball_volume(b);
    return out;
  }
  const double inverse = 1.0 / distance;
  const double l_a = 0.5 * (distance + shift * inverse), l_b = 0.5 * (distance - shift * inverse);
  const double h_a = a - l_a, h_b = b - l_b;
  const double disc = std::numbers::pi * h_a * (a + l_a);
  const double twist = disc * shift * inverse * inverse * inverse;
  const double shrink = 2.0 * std::numbers::pi * l_a * l_b * inverse * inverse;
  out.volume_a = (std::numbers::pi / 3.0) * h_a * h_a * (3.0 * a - h_a);
  out.volume_b = (std::numbers::pi / 3.0) * h_b * h_b * (3.0 * b - h_b);
  out.slope_a = disc * l_b * inverse;
  out.slope_b = disc * l_a * inverse;
  out.curvature_a = shrink * l_b - twist;
  out.curvature_b = shrink * l_a + twist;
  return out;
}

/// Cap of a sphere behind a plane at this overlap h = R − distance [µm]: volume πh²(3R − h)/3 and slope dv/dh = πh(2R − h).
struct PlaneCap {
  double volume = 0.0;  ///< [µm³]
  double slope = 0.0;   ///< [µm²]
};
constexpr PlaneCap plane_cap(double radius, double overlap) noexcept {
  if (overlap <= 0.0) return {};
  const double h = overlap < 2.0 * radius ? overlap : 2.0 * radius;
  return {(std::numbers::pi / 3.0) * h * h * (3.0 * radius - h), std::numbers::pi * h * (2.0 * radius - h)};
}

}  // namespace morula::cbm
