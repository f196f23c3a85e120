#pragma once
#include <span>

#include "coupling/mechanics/workspace.h"

namespace morula {

/// Steps of the usual loop that let the owned bodies with moves[body] != 0 settle between all others (Mechanics::relax). Collective.
Status relax_in_place(Workspace& work, Tissue& tissue, std::span<const char> moves);

}  // namespace morula
