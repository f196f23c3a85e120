#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "core/cell_id.h"
#include "core/contact/contact_layer.h"
#include "core/parallel/comm.h"
#include "coupling/model.h"
#include "coupling/tissue.h"

namespace morula {

/// Cells whose bodies find their shape together, and those that they may touch on the way: nobody else has a part in it.
struct Neighbourhood {
  std::vector<CellId> movers;     ///< of all ranks, sorted
  std::vector<std::size_t> rows;  ///< of this rank: the movers and what they may touch, increasing
  int owner = 0;                  ///< rank of the first mover
  bool on_one_rank = true;        ///< no other rank has any of its cells
  bool for_all_ranks = false;     ///< so large that all ranks work on it
};

/// How far bodies act on each other, and how far those that find their shape may go meanwhile.
struct Reach {
  double touch = 0.0;  ///< between two surfaces [µm]
  double way = 0.0;    ///< of a mover's surface, in units of the size of its box
  bool packs = false;  ///< a sphere presses on its neighbours by how it is packed: what touches them counts, too
};

/// The neighbourhoods of the cells `movers` of this rank (sorted), in the order of their first movers; the same on all ranks but for the rows.
/// Movers that may touch each other, or the same sphere that resists its packing, are in one. Collective.
std::vector<Neighbourhood> find_neighbourhoods(const Tissue& tissue, const Space& space, std::span<const CellId> movers, const Reach& reach,
                                               const Comm& comm);

/// Whether all cells of the tissue act on each: a spring of marked faces goes to the middle of all of them.
[[nodiscard]] bool everybody_has_a_part(const Model& model);

/// The neighbourhoods of all that acts on `movers` by the contacts of a model, or that they act on, as long as they go no further than `way`
/// (Reach::way); the whole tissue where everybody has a part in it. Collective.
std::vector<Neighbourhood> neighbourhoods_of(const Tissue& tissue, const Model& model, const ContactSettings& contact,
                                             std::span<const CellId> movers, double way, const Comm& comm);

double largest_edge(const Box& box);
/// Where a cell is: the centroid of its volume [µm].
Vec3d center_of(const Tissue& tissue, const BodyOfRow& body);
/// The box around a cell's body.
Box box_of(const Tissue& tissue, const BodyOfRow& body);

}  // namespace morula
