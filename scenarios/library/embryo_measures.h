#pragma once
#include <span>
#include <vector>

#include "core/vec3.h"
#include "results/snapshot.h"

namespace morula::scenarios {

/// Root mean square distance of two lists of places after the rigid motion (turn and shift, no mirror) that makes it least [µm]: the largest
/// eigenvalue of Horn's matrix (Horn 1987, doi:10.1364/JOSAA.4.000629) by Newton's method (Theobald 2005, doi:10.1107/S0108767305015266).
/// Both lists are of the same length, not empty.
double rms_after_rigid_motion(std::span<const Vec3d> a, std::span<const Vec3d> b);

/// One-sided p of the test of Mann & Whitney (1947, doi:10.1214/aoms/1177730491) that `upper` tends to be larger than `lower`: normal
/// approximation with correction for ties and continuity. 1 where a list is empty.
double mann_whitney_p(std::span<const double> lower, std::span<const double> upper);

/// A ball that does not count as outside: the cavity of an embryo.
struct Cavity {
  Vec3d center;
  double radius = 0.0;  ///< 0: none [µm]
};

/// By cell of the snapshot: the part of its surface that a ball of radius `probe` [µm] can touch when it rolls over the tissue from far away. The ball
/// passes no gap that is narrower than itself, so that a crevice between two cells exposes no third one, and its centre never enters the
/// cavity, so that the cavity's walls do not count, closed or not (rolling ball: Richards 1977, doi:10.1146/annurev.bb.06.060177.001055).
///
/// Where the ball can be is found on a grid of a fifth of its radius; shells are met at their nodes and the middles of their faces.
std::vector<double> outer_surface_fractions(const Snapshot& snapshot, double probe, const Cavity& cavity);

}  // namespace morula::scenarios
