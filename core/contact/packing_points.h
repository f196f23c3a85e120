#pragma once
#include "core/contact/surface_pair.h"

namespace morula {

/// Pressure of a sphere by its packing, as the surfaces that press into it feel it (cbm.md §3; fields_and_coupling.md, D).
struct SpherePressure {
  double pressure = 0.0;  ///< p = Ψ′(φ) [kPa]
  double resistance = 0.0;  ///< bound on Ψ″/V · Σ |∂v/∂d| over all contacts of the sphere: the operator's stiffness per area [kPa/µm]
};

/// What a surface takes of a sphere: Σ A_q f(r_q) and how fast it grows, Σ A_q |f′(r_q)|.
struct Penetration {
  double volume = 0.0;  ///< [µm³]
  double slope = 0.0;   ///< [µm²]
};

/// f(r) = (R² − r²)/(2r) for r < R, the volume of the sphere that lies behind a unit of area at distance r from its centre: integrated over a
/// plane it gives the cap πh²(3R − h)/3 exactly, so that a flat neighbour counts as another sphere does. [µm]
struct PackingDepth {
  double depth = 0.0, slope = 0.0, curvature = 0.0;  ///< f, |f′|, f″
  static PackingDepth of(double distance, double radius) noexcept {
    if (distance >= radius) return {};
    const double r = distance > 0.1 * radius ? distance : 0.1 * radius;  // a face through the centre: stay finite
    const double square = radius * radius, inverse = 1.0 / r;
    return {0.5 * (square * inverse - r), 0.5 * (square * inverse * inverse + 1.0), square * inverse * inverse * inverse};
  }
};

/// Over the quadrature points of these faces of a surface, those within the sphere.
Penetration penetration(const PairBody& surface, const PairBody& sphere, const FaceQuadrature& quadrature,
                        std::span<const std::uint32_t> faces) noexcept;

/// Forces of the pressure on the points of body d (a surface) within body 1 − d (a sphere), and elements for the operator, beside those of
/// evaluate_points(), after it. The energy V Ψ(φ) is the sphere's, not the pair's.
void add_packing(const PairBody& surface, const PairBody& sphere, const FaceQuadrature& quadrature, const SpherePressure& pressure, int d,
                 const SurfacePair& pair, PairGradient (&gradient)[2], std::vector<ContactElement>& elements);

}  // namespace morula
