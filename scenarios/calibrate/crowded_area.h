#pragma once
#include <span>
#include <vector>

#include "cbm/crowded_area.h"
#include "scenarios/calibrate/data.h"
#include "scenarios/calibrate/pair_model.h"

namespace morula::calibrate {

/// A random packing: areas of a cell with all its neighbours, over the surface of its ball.
struct CrowdedPoint : cbm::CrowdedKnot {
  bool held_out = false;
};

/// Contact areas of cells in random packings, beside those that pairs of the law say of spheres in their place, and how wrong the curve is.
struct FittedCrowding {
  std::vector<cbm::CrowdedKnot> knots;
  std::vector<CrowdedPoint> points;  ///< what it was fitted to and judged by
  double held_out =
      0.0;  ///< of packings that were not fitted: error of the contact area with the curve, root mean square, over that of the shells
  double pairs_alone = 0.0;  ///< the same by pairs alone
  int packings = 0;          ///< that were held out
};

/// Contact area of a cell over its ball's surface where it has one neighbour with which it is at rest by the law; 0: pairs that never are.
[[nodiscard]] double resting_share(const PairModel& pair, double radius);

/// The curve: cells with one neighbour at rest have the area of their pair (the first knot); then the means of the random packings that are not held out, taken
/// together in up to eight of about as many points by the part that pairs say: the area rises until the cells fill the room, and falls a little as they are
/// pressed smaller. Points without areas, or where no spheres were placed, tell nothing. No knots: nothing tells.
[[nodiscard]] FittedCrowding fit_crowded_area(std::span<const PackingPoint> packings, double resting_share);

}  // namespace morula::calibrate
