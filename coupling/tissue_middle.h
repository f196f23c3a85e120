#pragma once
#include <span>

#include "core/parallel/comm.h"
#include "core/space/space.h"

namespace morula {

/// From where the places of a tissue's cells are measured: the middle of the domain; along periodic axes the direction in which the cells' weights lie about a
/// circle, so that a tissue across a face is one.
struct TissueMiddle {
  Vec3d at;  ///< [µm]
  double directed[3] = {
      0.0, 0.0, 0.0};  ///< along each axis how far the weights are on one side: 0 all around, 1 all in one place; 0 where not periodic
};

/// `weight`: by centre; empty: all alike. Collective.
TissueMiddle tissue_middle(const Space& space, std::span<const Vec3d> center, std::span<const double> weight, const Comm& comm);

}  // namespace morula
