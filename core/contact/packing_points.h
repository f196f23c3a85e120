#pragma once
#include "core/contact/surface_pair.h"
#include "core/mesh/face_quadrature.h"

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
///
/// f begins at r = R with a slope: each quadrature point that crosses the sphere's surface would change the force at once, though the integral
/// has no such kink. It sets in over a width w instead (decision 0025): the depth d = R − r is replaced by h(d) = (d + w/2)²/(2w) for
/// |d| < w/2. A cap on a plane grows by 2πR w²/24 through it.
struct PackingDepth {
  double depth = 0.0, slope = 0.0, curvature = 0.0;  ///< f, −f′, f″ over the distance
  /// `onset`: w [µm]; 0: none.
  static PackingDepth of(double distance, double radius, double onset) noexcept {
    const double d = radius - distance;
    if (d <= -0.5 * onset) return {};
    double h = d, first = 1.0, second = 0.0;
    if (d < 0.5 * onset) {
      first = (d + 0.5 * onset) / onset;
      second = 1.0 / onset;
      h = 0.5 * onset * first * first;
    }
    const double r = radius - h > 0.1 * radius ? radius - h : 0.1 * radius;  // a face through the centre: stay finite
    const double square = radius * radius, inverse = 1.0 / r;
    const double slope = 0.5 * (square * inverse * inverse + 1.0);
    return {0.5 * (square * inverse - r), slope * first, square * inverse * inverse * inverse * first * first + slope * second};
  }
};

/// Width w of the onset, in units of the contact range: points come that near within the reach of the lists, and the rim of a contact is as wide.
inline constexpr double kPackingOnset = 0.4;

/// Over the quadrature points of these faces of a surface, those within the sphere. `onset`: of PackingDepth [µm].
Penetration penetration(const PairBody& surface, const PairBody& sphere, const FaceQuadrature& quadrature,
                        std::span<const std::uint32_t> faces, double onset) noexcept;

/// Forces of the pressure on the points of body d (a surface) within body 1 − d (a sphere), and elements for the operator, beside those of
/// evaluate_points(), after it. The energy V Ψ(φ) is the sphere's, not the pair's.
void add_packing(const PairBody& surface, const PairBody& sphere, const FaceQuadrature& quadrature, const SpherePressure& pressure,
                 double onset, int d, const SurfacePair& pair, PairGradient (&gradient)[2], std::vector<ContactElement>& elements);

}  // namespace morula
