#pragma once
#include <vector>

#include "core/result.h"
#include "scenarios/calibrate/confidence.h"

namespace morula::calibrate {

/// Force between a sphere and a shell at the places of a comparison, with one choice of both factors.
struct MixedTrial {
  double stiffness = 1.0, adhesion = 1.0;  ///< over what follows from the sphere's modulus and from W
  std::vector<double> force;               ///< by place, > 0 pushes apart [nN]
  double way = 0.0;                        ///< outwards, of the neighbours of a sphere that becomes a shell, over R
};

/// What a sphere with a shell should bear, and what it bears with some factors.
struct MixedData {
  std::vector<double> wanted;  ///< by place: halfway between two shells and two spheres [nN]
  std::vector<MixedTrial> trials;
  double scale = 1.0;      ///< of forces, their pull-off [nN]
  double way_scale = 0.0;  ///< a way of this counts what a force does that is wrong by `scale`; 0: no way is known
};

/// Factors with which a pair of both bodies lies between the pairs of each.
struct MixedFit {
  double stiffness = 1.0, adhesion = 1.0;
  Interval stiffness_interval,
      adhesion_interval;   ///< 95 %: eighths of the places left out in turn, the way never (jackknife, Student's t of 7)
  bool at_border = false;  ///< a factor is the least or the largest that was tried
};

/// Least squares of (F − wanted)/scale, and of way/way_scale, over both factors. At each place F, and the way, is the quadratic polynomial of their logarithms through the trials (least squares): what
/// the nodes of one mesh do by chance is averaged over all of them. Factors stay within those that were tried; one that all trials have in common stays.
/// Errors (kInput): fewer trials than a polynomial has terms; fewer than 16 places; trials with another number of places.
Result<MixedFit> fit_mixed(const MixedData& data);

}  // namespace morula::calibrate
