#pragma once
#include <cstdint>
#include <vector>

#include "core/parallel/comm.h"
#include "coupling/model.h"
#include "coupling/tissue.h"

namespace morula {

/// The springs of all loads that hold nodes (Load::hold) at a time, on the rank's shells. A grip holds the end nodes of a cell where they would be on an
/// undeformed cell (the reference shape at the cell's target volume) whose centre is that of the grip and has gone along the grip's way; its
/// stiffness is shared evenly by the nodes of an end and follows the load's course. Nothing of it is stored: it follows from the study and
/// the time.
std::vector<Anchor> grip_anchors(const Model& model, const Tissue& tissue, double time);

/// Force of each load that is a grip on its cells at the tissue's positions and time [nN]; 0 for other loads. Collective, the same on every rank.
std::vector<Vec3d> grip_forces(const Model& model, const Tissue& tissue, const Comm& comm);

}  // namespace morula
