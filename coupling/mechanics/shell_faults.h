#pragma once
#include <cstddef>
#include <optional>
#include <span>

#include "coupling/mechanics/step_report.h"
#include "dcm/shell_fault.h"

namespace morula {

/// Of shells that cannot have the shape that they have, that of the first cell; `cell_of(k)` is the one of the k-th.
template <class CellOf>
std::optional<StepFault> first_fault(std::span<const dcm::ShellFault> faults, CellOf&& cell_of) {
  std::optional<StepFault> out;
  for (std::size_t k = 0; k < faults.size(); ++k)
    if (faults[k] && (!out || cell_of(k) < out->cell)) out = StepFault{dcm::describe(faults[k]), cell_of(k), true, StepFault::kNoShape};
  return out;
}

}  // namespace morula
