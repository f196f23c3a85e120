#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/behaviours/life.h"

namespace morula {

/// What the behaviours of a cell ask for in a step, and of which one it dies.
struct Asked {
  CellWish wish;
  std::uint16_t deadly = 0;  ///< where the cell is to die: number of the first behaviour of its type that asked for it
};

/// The behaviours of the cells of a rank in one step.
class AskBehaviours {
 public:
  /// Makes room for the variables that behaviours keep.
  AskBehaviours(Cells& cells, std::span<const CellType> types, const LifeStep& step);

  /// Asks those of one cell, which change its own variables. For different rows by several threads at once.
  [[nodiscard]] Asked ask(std::size_t row);
  /// The factor of the rate at which a phase of a cell passes. As above; nothing is changed.
  [[nodiscard]] double phase_rate(std::size_t row, std::size_t phase) const;

 private:
  [[nodiscard]] CellView look_at(std::size_t row) const;

  Cells& cells_;
  std::span<const CellType> types_;
  const LifeStep& step_;
  std::vector<std::vector<std::size_t>> first_variable_;  ///< by type and behaviour
  std::vector<std::size_t> place_;                        ///< of the bodies, by row, where any behaviour looks at them
};

/// Whether a behaviour or an arrest of any type needs LifeStep::bodies.
bool look_at_bodies(std::span<const CellType> types);

}  // namespace morula
