#pragma once
#include <span>
#include <vector>

#include "core/parallel/comm.h"
#include "coupling/behaviours/division_axis.h"
#include "coupling/mechanics/mechanics.h"
#include "coupling/tissue.h"

namespace morula {

/// What the axes of these mothers of the rank look at around them, in their order, at present positions. Collective.
Result<std::vector<AroundDivision>> look_around(const Model& model, const Tissue& tissue, Mechanics& mechanics, const Comm& comm,
                                                std::span<const BodyOfRow> mothers);

}  // namespace morula
