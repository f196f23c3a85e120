#pragma once
#include <string>

#include "core/parallel/comm.h"

namespace morula::app {

/// What is to be said where ranks × threads are more than the cores they may run on; else empty. Of the machine where it is worst. Looks at the
/// cores that the ranks of one machine are allowed together, and at those of each rank, which mpirun may have bound. Collective.
[[nodiscard]] std::string crowded_cores(int threads, const Comm& comm);

}  // namespace morula::app
