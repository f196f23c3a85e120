#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "core/mesh/topology.h"
#include "core/numbers/hash128.h"
#include "core/parallel/comm.h"
#include "core/result.h"
#include "results/hdf5_plan.h"
#include "results/hdf5_reader.h"

namespace morula::scenarios {

/// Numbers of the stress-free shapes in a file: every shape once, whatever rank has it, in the order of their hashes.
struct ShapeNumbers {
  std::map<const ReferenceShape*, std::uint32_t> by_pointer;  ///< of this rank's shapes
};

/// Collective. Adds the group `shapes` to the plan: all shapes of all ranks, each once.
ShapeNumbers add_shapes(StoragePlan& plan, const std::vector<std::shared_ptr<const ReferenceShape>>& shapes, const Comm& comm);

/// The shapes with these numbers (sorted, each once), as they were, bit for bit. A shape of the library is the library's own object.
Result<std::map<std::uint32_t, std::shared_ptr<const ReferenceShape>>> read_shapes(const Hdf5Reader& file,
                                                                                   const std::vector<std::uint32_t>& numbers,
                                                                                   ShapeLibrary& library);

}  // namespace morula::scenarios
