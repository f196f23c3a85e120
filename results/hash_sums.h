#pragma once
#include <span>

#include "core/numbers/hash128.h"
#include "core/parallel/comm.h"

namespace morula::scenarios {

/// Each hash becomes its sum over all ranks. Collective.
void sum_over_ranks(std::span<Hash128> hashes, const Comm& comm);

}  // namespace morula::scenarios
