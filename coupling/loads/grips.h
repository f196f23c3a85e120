#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel/comm.h"
#include "coupling/model.h"
#include "coupling/tissue.h"

namespace morula {

/// The springs of all loads that hold cells at places (Load::holds()) at a time, on the rank's cells. A grip holds the end nodes of a cell where they would
/// be on an undeformed cell (the reference shape at the cell's target volume) whose centre is that of the grip and has gone along the grip's way; its
/// stiffness is shared evenly by the nodes of an end and follows the load's course. A trap holds the centre of a cell. Nothing of it
/// is stored: it follows from the study and the time.
std::vector<Anchor> grip_anchors(const Model& model, const Tissue& tissue, double time);

/// The spring, on the centre of a shell or a sphere of the rank, by its number among these.
Anchor on_center(Anchor spring, const Tissue& tissue, bool is_shell, std::size_t number);

/// Where what a spring holds is [µm].
Vec3d held_place(const Anchor& anchor, const Tissue& tissue);
/// Force of a spring on what it holds [nN].
Vec3d pull_of(const Anchor& anchor, const Tissue& tissue);
/// Adds that force to the nodes of the rank's shells, as they bear it in a step; nothing for a sphere.
void add_pull(const Anchor& anchor, const Tissue& tissue, std::span<Vec3d> force);

/// Force of each load that holds cells on them at the tissue's positions and time [nN]; 0 for other loads. Collective, the same on every rank.
std::vector<Vec3d> grip_forces(const Model& model, const Tissue& tissue, const Comm& comm);

}  // namespace morula
