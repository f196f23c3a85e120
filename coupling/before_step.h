#pragma once
#include <cstddef>
#include <vector>

#include "coupling/tissue.h"

namespace morula {

/// What a step changes before its mechanics say whether it can be done, as it was at the step's start: the columns of cells and bodies that are declared
/// to grow. Their room is kept from step to step.
class BeforeStep {
 public:
  void keep(const Tissue& tissue);
  /// Gives a tissue what keep() found in it; no row and no body has come or gone since.
  void restore(Tissue& tissue) const;
  [[nodiscard]] std::size_t memory() const;  ///< [B]

 private:
  // Of each only the columns that grow.
  std::vector<std::byte> of_rows_;  ///< row by row, one value behind the other
  OptionalColumns optional_;
  std::vector<OptionalColumn<double>> variables_;
  dcm::Shells shells_, nuclei_;
  cbm::Spheres spheres_;
};

}  // namespace morula
