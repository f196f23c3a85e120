#pragma once
#include <cmath>

#include "core/simd/lane.h"

namespace morula {

/// How much the gap varies over the part of a face that a quadrature point stands for.
///
/// At the rim of a contact the gap opens by the whole range over less than the distance of two points. A point that answers by its own gap alone
/// takes its part of the face into the contact all at once, and the contact line rests between two rows of points. Both surfaces count as flat
/// around the point, so that the gap changes along the face by √(1 − m²) per length, m = −n_T·n_y, the cosine of the angle between them. Over a
/// piece of area a with the second moment κa about any axis its variance is κa (1 − m²). The law is averaged over three gaps with this variance,
///   g − h, g, g + h,   h² = (3/2) κ a (1 − m²).
/// The program takes (3/2) κ = 0.15: an equilateral triangle has κ = 1/(6√3) = 0.096, a third of it, from a corner to the middles of two edges
/// and of the face, 0.088. Two limits: faces within asin √0.06 = 14° of each other have no spread, since meshes in flat contact are as uneven as
/// that, f(s) = (s − 0.06)²/s instead of s = 1 − m²; and h stays below 0.6 of the range, so that points farther away are none of a contact.
///
/// Real: double or a lane. A lane does not depend on its neighbours. Decision 0048 has the figures.
template <class Real>
struct GapSpread {
  Real half;           ///< h [µm]; 0: none
  Real by_opposition;  ///< ∂h²/∂m [µm²]
  Real by_area;        ///< ∂h²/∂a

  static constexpr double kPart = 0.25, kFlat = 0.2, kMost = 0.6;

  /// m: opposition of the two surfaces; area: a [µm²]; range: c [µm].
  static GapSpread of(Real m, Real area, double range) noexcept {
    using std::sqrt;
    const Real zero(0.0), one(1.0), flat(kFlat);
    const Real tilt = one - m * m, s = select(tilt > flat, tilt, flat), beyond = s - flat, ratio_to_flat = flat / s;
    const Real f = beyond * beyond / s, f_slope = one - ratio_to_flat * ratio_to_flat;
    const double most = kMost * range;
    const Real free = Real(kPart) * area * f, over = free * Real(1.0 / (most * most)), cut = one / sqrt(one + over * over);
    const Real square = free * cut, slope = cut * cut * cut;  // h² and ∂h²/∂free
    const auto some = square > Real(1e-12 * range * range);
    return {select(some, sqrt(square), zero), select(some, slope * Real(kPart) * area * f_slope * Real(-2.0) * m, zero),
            select(some, slope * Real(kPart) * f, zero)};
  }
};

/// How far beyond the range c points may lie that have a part in a contact [µm].
inline double most_spread(double range) { return GapSpread<double>::kMost * range; }

}  // namespace morula
