#pragma once
#include <cstdint>
#include <span>

#include "coupling/mechanics/workspace.h"

namespace morula {

/// The deepest overlap at which surfaces may go on without a capped start [µm].
inline constexpr double kOverlapAtRest = 0.1;

/// So many bodies that settle together are a group: one of them goes far, and some rim goes on for long.
inline constexpr std::int64_t kGroup = 32;

/// Steps of the usual loop that let the owned bodies with moves[body] != 0 settle between all others (Mechanics::relax). Collective.
double relax_in_place(Workspace& work, Tissue& tissue, std::span<const char> moves);

/// The same with contacts as they are, until a step of this length [s] is an ordinary one (Mechanics::move_alone). Collective.
void march_in_place(Workspace& work, Tissue& tissue, std::span<const char> moves, double step);

}  // namespace morula
