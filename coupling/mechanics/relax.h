#pragma once
#include <span>

#include "coupling/mechanics/workspace.h"

namespace morula {

/// The deepest overlap at which surfaces may go on without a capped start [µm].
inline constexpr double kOverlapAtRest = 0.1;

/// Steps of the usual loop that let the owned bodies with moves[body] != 0 settle between all others (Mechanics::relax). Collective.
double relax_in_place(Workspace& work, Tissue& tissue, std::span<const char> moves);

}  // namespace morula
