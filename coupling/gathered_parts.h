#pragma once
#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "coupling/cell_record.h"
#include "coupling/mechanics/mechanics.h"
#include "coupling/neighbourhoods.h"

namespace morula {

/// Neighbourhoods of a tissue as tissues of their own, each on the rank of its first mover or, where it is large, on all. The tissue stays as it is,
/// and what is found in a part does not depend on the number of ranks.
class GatheredParts {
 public:
  /// `mechanics`: of the whole tissue; all given things stay until the parts have been visited. Collective.
  GatheredParts(const Tissue& tissue, std::span<const Neighbourhood> all, const Mechanics& mechanics, ShapeLibrary& shapes,
                const Comm& comm);

  /// What is done with a part: its movers, the part or what this rank has of it, mechanics for it, and the ranks that look at it together.
  using Visit = std::function<void(std::span<const CellId>, Tissue&, Mechanics&, const Comm&)>;
  /// For all parts that this rank looks at. Collective.
  void visit(const Visit& visit) const;

  /// A cell on its way back to its own rank, with a mark.
  struct Returned {
    CellRecord cell;
    bool marked = false;
  };
  /// Cells of the parts go home: `cells` of this rank's parts; gives those whose rank this is. Collective.
  [[nodiscard]] std::vector<Returned> send_home(std::vector<Returned> cells) const;

 private:
  [[nodiscard]] std::vector<CellRecord> cells_of(const Neighbourhood& n) const;
  [[nodiscard]] Tissue part_of(std::size_t number) const;

  const Tissue& tissue_;
  std::span<const Neighbourhood> all_;
  const Mechanics& mechanics_;
  ShapeLibrary& shapes_;
  const Comm& comm_;
  std::vector<BodyOfRow> bodies_;                            ///< of the rows in any neighbourhood, increasing
  bool across_ = false;                                      ///< some part has cells of several ranks
  std::map<std::uint64_t, std::vector<CellRecord>> guests_;  ///< of other ranks, by part
  std::map<CellId, int> home_;                               ///< ranks of the guests
};

}  // namespace morula
