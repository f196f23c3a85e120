#pragma once
#include <span>
#include <vector>

#include "core/cell_id.h"
#include "coupling/simulation.h"

namespace morula {

/// The largest value over all cells and the cell that has it (the lowest id where several do); no cell: value 0.
struct Extreme {
  double value = 0.0;
  CellId cell;

  /// Takes the value of this cell if it is larger, or as large and the id lower.
  void offer(double candidate, CellId of) {
    if (!cell.valid() || candidate > value || (candidate == value && of < cell)) value = candidate, cell = of;
  }
};

/// The deepest penetration of a surface on this rank, into another surface, an obstacle or a nucleus, after an evaluation of the contacts [µm].
Extreme deepest_overlap(Simulation& simulation);

/// The cells of this list that lie deeper than this within another surface, or their nucleus within their own, as the contacts were found last. `these` is sorted; so is the answer.
std::vector<CellId> too_deep(const Mechanics& mechanics, std::span<const CellId> these, double depth);

}  // namespace morula
