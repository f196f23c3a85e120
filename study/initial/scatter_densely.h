#pragma once
#include "study/initial/packing.h"

namespace morula::scenarios {

/// Whether a place, from the middle of the entry's shape, lies this deep in it [µm].
bool within(const InitialCells& block, const Vec3d& from_center, double inset);

/// The dense way of scatter_cells(): one cell in each cube of a lattice, anywhere in it, then all come apart.
Packing scatter_densely(const InitialCells& block, std::span<const double> radius, double touch, const Space& space,
                        std::uint64_t first_number, std::uint32_t seed, const Surroundings& around, int threads);

}  // namespace morula::scenarios
