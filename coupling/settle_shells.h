#pragma once
#include <span>
#include <vector>

#include "coupling/cell_record.h"
#include "coupling/mechanics/mechanics.h"

namespace morula {

/// How the new shells of a tissue have settled.
struct Settled {
  std::vector<CellId> no_room;   ///< those of this rank that are left too deep within a neighbour, sorted
  bool overlap_is_left = false;  ///< in a neighbourhood where not all are in no_room; the same on all ranks
};

/// The new shells `fresh` of this rank (sorted) find their shape between their neighbours, at their volume; nobody else moves (decision 0042).
///
/// Shells that may touch each other settle together, the others each for themselves, in a scene of the cells within reach alone: the result does
/// not depend on what else settles, nor on ranks and threads. A neighbourhood that lies on several ranks settles on the rank of its first new
/// shell. `mechanics` is that of the tissue; nothing in it changes. `may_go_back`: false where cells become what the study says, however little
/// room they have. Collective.
Settled settle_shells(Tissue& tissue, const Mechanics& mechanics, const Model& model, ShapeLibrary& shapes, const Comm& comm,
                      std::span<const CellId> fresh, bool may_go_back);

/// The new daughters of cut shells of this rank (sorted) go on between their neighbours, which are held, in steps of their own, until a step as long as
/// `step` [s] is an ordinary one for them, too: the rims of a cut are in no balance, and a whole tissue would wait for them (decision 0062). As above:
/// each neighbourhood for itself, the same on any ranks. Collective.
void settle_daughters(Tissue& tissue, const Mechanics& mechanics, const Model& model, ShapeLibrary& shapes, const Comm& comm,
                      std::span<const CellId> daughters, double step);

/// Scale a closed mesh about its centroid so that it encloses exactly this volume.
void set_enclosed_volume(const Topology& topology, std::span<Vec3d> nodes, double volume);

}  // namespace morula
