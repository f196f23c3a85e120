#pragma once
#include <functional>
#include <vector>

#include "core/result.h"
#include "scenarios/calibrate/relaxation.h"

namespace morula::calibrate {

/// A ball of cells between two plates that come nearer at a constant speed: the work of the plates over the way that they have come.
struct PressedCluster {
  std::vector<double> part;  ///< of the way of the plates, increasing, from 0 to 1
  std::vector<double> work;  ///< of both plates until then [fJ]
};

/// The work from the mean of the forces of both plates at these parts of their way [nN], each of which comes this far [µm]. Forces are taken as straight in between.
PressedCluster pressed_cluster(std::vector<double> part, const std::vector<double>& force, double way);

/// Friction along the contact, and what it makes of the clusters: mean work, by part of the way, in parts of that of the shells over the whole way.
struct FittedAlong : FittedFriction {
  std::vector<double> part;
  std::vector<double> shells, fitted, unfitted;  ///< of spheres with the fitted friction and with that of the shells
};

/// The clusters of the shells, of spheres whose friction along their contacts is this part of that of the shells.
using ClustersOfSpheres = std::function<Result<std::vector<PressedCluster>>(double factor)>;

/// Friction along the contact of two spheres, per contact area, with which they go past each other as shells do: the factor, of all powers of two from 1/1024 to 4 and then
/// between them, where the work is taken as straight in the logarithm, for which the mean work on the clusters is nearest to that on the shells, by least squares over sixteen parts of the way. The
/// interval (95 %) comes from clusters left out one by one (jackknife, Student's t of logarithms); `misfit`: root mean square of what is left, over the
/// shells' work. `friction`: γ_t of the shells [nN·s/µm³].
/// Errors (kInput): no cluster; shells that resist nothing, or have no friction along their contact; a best factor at either end of those that are tried, which the
/// work then does not tell. Those of `spheres`.
Result<FittedAlong> fit_friction_along(const std::vector<PressedCluster>& shells, double friction, const ClustersOfSpheres& spheres);

}  // namespace morula::calibrate
