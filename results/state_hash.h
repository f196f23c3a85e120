#pragma once
#include <memory>

#include "core/numbers/hash128.h"
#include "core/parallel/comm.h"
#include "coupling/tissue.h"

namespace morula::scenarios {

/// Collective. A hash of the whole Tissue over all ranks: the same bits of state give the same hash, and (but for chance, 2^-128) only they.
/// It does not depend on the number of ranks or threads, nor on the order in which cells, partners or bricks are kept.
///
/// What enters, bit for bit (so −0.0 and 0.0 differ): every member of every row, keyed by the cell's id; of its sphere position,
/// radius, type, velocity and the ids of its partners; of its shell the stress-free shape (faces, positions, lengths, areas, angles), type,
/// reference and rest volume, node positions and velocities, rest lengths; every brick of every field, keyed by field and brick number,
/// with the grid and the integrator's next step; the obstacles' offsets; clock and ledger (of the root: all ranks hold the same).
/// What does not enter: padding, indices of bodies, and which rank holds what.
Hash128 state_hash(const Tissue& tissue, const Comm& comm);

/// A hash of everything in a stress-free shape, its connectivity included.
Hash128 shape_hash(const ReferenceShape& shape);

}  // namespace morula::scenarios
