#pragma once
#include <functional>

#include "scenarios/measures/finished_run.h"

namespace morula::scenarios {

/// Calls visit(snapshot, cell, way) at the outputs `wanted` (increasing), for each cell that was there at the output `from`: the way of its centre since then
/// [µm]. Across periodic faces it is the sum of the shortest ways from output to output: a cell that goes half the domain between two is not known.
Status for_ways_since(FinishedRun& run, std::size_t from, const std::vector<std::size_t>& wanted,
                      const std::function<void(const Snapshot&, const Snapshot::Cell&, const Vec3d&)>& visit);

}  // namespace morula::scenarios
