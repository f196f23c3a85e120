#pragma once
#include <vector>

#include "core/vec3.h"
#include "results/snapshot.h"

namespace morula::scenarios {

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
