#pragma once
#include <span>
#include <vector>

#include "core/mesh/topology.h"
#include "coupling/active_terms.h"

namespace morula {

/// What a front is on.
struct Footing {
  std::span<const char> touches{};  ///< by node: in touch with the substrate; empty: there is none
  Vec3d normal{};                   ///< of the substrate, of length 1
};

/// Forces of the protrusion of one shell along its polarity p, added to `force` by node [nN].
///
/// The front are the nodes whose way from the cell's centroid makes less than the angle α with p: weights a_i (cos θ_i − cos α), a_i the node's area,
/// f_i = F w_i p/Σ w. On a substrate only nodes in touch with it count, and their angle is that along it: of their ways with `direction`. With an internal
/// reaction −F is borne by the rear, in the same way about −p, so that ΣF = 0.
///
/// `direction`: of the force, need not be of length 1; on a substrate, along it. `size`: F [nN]. Returns whether there is a front.
bool add_protrusion(const Protrusion& law, const Topology& topology, std::span<const Vec3d> position, const Vec3d& polarity,
                    const Footing& footing, const Vec3d& direction, double size, std::span<Vec3d> force);

}  // namespace morula
