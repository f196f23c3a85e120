#pragma once
#include <functional>
#include <span>
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

/// The clusters of the shells, of spheres whose friction along their contacts is each of these parts of that of the shells.
using ClustersOfSpheres = std::function<Result<std::vector<std::vector<PressedCluster>>>(std::span<const double> factors)>;

/// Friction along the contact of two spheres, per contact area, with which they go past each other as shells do: a factor between 1/1024 and 4. What speaks against one is how far the mean
/// work is from that on the shells, over sixteen parts of the way, beside the scatter of single clusters and what no factor takes away (Student's t), and how far it is from the factor of
/// approach, of which the logarithm is taken to differ by a standard deviation of ln 4 where nothing tells it. Between powers of two the work is taken as straight in the logarithm.
/// The interval (95 %) is where this loss is less than 3.84 above its least; an end that no factor reaches is 0 or infinite. `misfit`: root mean square of what is left, over the
/// shells' work. `friction`: γ_t of the shells [nN·s/µm³]; `approach`: the factor on their friction across the contact.
/// Errors (kInput): no cluster; shells that resist nothing, or have no friction along their contact. Those of `spheres`.
Result<FittedAlong> fit_friction_along(const std::vector<PressedCluster>& shells, double friction, double approach,
                                       const ClustersOfSpheres& spheres);

}  // namespace morula::calibrate
