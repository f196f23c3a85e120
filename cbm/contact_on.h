#pragma once
#include "core/contact/surface_curvature.h"

namespace morula::cbm {

/// What a surface that is hollow around a sphere makes of its radius at most: beyond it the contact is no small part of the sphere.
inline constexpr double kMostOfHollow = 2.0;

/// The round contact with a plane that stands for one with a surface that bends.
struct ContactOn {
  double radius = 0.0;  ///< R* [µm]
  double area = 1.0;    ///< of the ellipse, as a part of the area of the round contact at the same overlap
};

/// The contact of a sphere of radius R [µm] with a surface of this curvature: the sphere of radius R* on a plane gives way to the same force by the same overlap.
///
/// A contact of principal curvatures p = 1/R + κ is an ellipse. Its overlap and mean radius are those of a round contact of radius R_e = 1/√(p₁p₂) times factors F₂(p₁/p₂) and
/// F₁(p₁/p₂) ≤ 1 (Hertz; Johnson 1985, Contact Mechanics, §4.2), δ ∝ F₂ R_e^(−1/3), so that R* = R_e/F₂³, and its area π F₁² F₂² R*δ. Here F₂ = 1 − ((p₁/p₂)^0.0684 − 1)^1.531 and
/// F₁ = 1 − ((p₁/p₂)^0.0602 − 1)^1.456, fits within 0.4 % up to p₁/p₂ = 50. Exact for spheres. Each p is at least 1/(2R): a surface that fits the sphere more closely acts as one
/// of twice its radius.
[[nodiscard]] ContactOn contact_on(double radius, const SurfaceCurvature& surface) noexcept;

}  // namespace morula::cbm
