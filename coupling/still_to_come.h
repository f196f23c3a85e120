#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/parallel/comm.h"
#include "coupling/mechanics/mechanics.h"
#include "coupling/model.h"
#include "coupling/tissue.h"

namespace morula {

/// What will still happen by itself to a tissue in which nothing moves, in words; empty: it stays as it is.
///
/// Counted are: what is prescribed over time (loads, obstacles, tensions, cavities, the medium), regions of bodies that begin or end, exchanges of
/// bodies that wait for their hold time or their turn, cells that inflate, grow, divide, die or shrink, young sisters that are let apart, reference
/// volumes and radii that ease after an exchange of bodies, water that flows, contact that tensions follow, the capped start, fields that cells may
/// die of, answer by water or by a change of body, and what drives cells on for ever (migration, fluctuations, protrusions that turn).
///
/// center: of the cells, by row. Collective; all ranks get the same.
std::vector<std::string> still_to_come(const Model& model, const Tissue& tissue, Mechanics& mechanics, std::span<const Vec3d> center,
                                       const Comm& comm);

}  // namespace morula
