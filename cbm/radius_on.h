#pragma once
#include "core/contact/surface_curvature.h"

namespace morula::cbm {

/// What a surface that is hollow around a sphere makes of its radius at most: beyond it the contact is no small part of the sphere.
inline constexpr double kMostOfHollow = 2.0;

/// The radius R* of the sphere that touches a plane as a sphere of radius R [µm] touches a surface that bends like this.
///
/// A contact of principal curvatures p = 1/R + κ is an ellipse. Its overlap is that of a round contact of radius R_e = 1/√(p₁p₂) times a factor F₂(p₁/p₂) ≤ 1
/// (Hertz; Johnson 1985, Contact Mechanics, §4.2), δ ∝ F₂ R_e^(−1/3), so that R* = R_e/F₂³; here F₂ = 1 − ((p₁/p₂)^0.0684 − 1)^1.531, a fit within 0.4 % up
/// to p₁/p₂ = 50. Exact for spheres. Each p is at least 1/(2R): a surface that fits the sphere more closely acts as one of twice its radius.
[[nodiscard]] double radius_on(double radius, const SurfaceCurvature& surface) noexcept;

}  // namespace morula::cbm
