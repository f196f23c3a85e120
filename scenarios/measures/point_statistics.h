#pragma once
#include <span>

#include "core/vec3.h"

namespace morula::scenarios {

/// Root mean square distance of two lists of places after the rigid motion (turn and shift, no mirror) that makes it least [µm]: the largest
/// eigenvalue of Horn's matrix (Horn 1987, doi:10.1364/JOSAA.4.000629) by Newton's method (Theobald 2005, doi:10.1107/S0108767305015266).
/// Both lists are of the same length, not empty.
double rms_after_rigid_motion(std::span<const Vec3d> a, std::span<const Vec3d> b);

/// One-sided p of the test of Mann & Whitney (1947, doi:10.1214/aoms/1177730491) that `upper` tends to be larger than `lower`: normal
/// approximation with correction for ties and continuity. 1 where a list is empty.
double mann_whitney_p(std::span<const double> lower, std::span<const double> upper);

}  // namespace morula::scenarios
