#pragma once
#include <string>
#include <vector>

#include "scenarios/measures/measure.h"
#include "scenarios/measures/theory.h"

namespace morula::scenarios {

/// A cell under light at an output.
struct StretchedCell {
  std::string cell;                 ///< id
  double time = 0.0, stress = 0.0;  ///< [s]; s0 [kPa]
  SecondMode measured;
  theory::Stretch linear;  ///< of the closed form, at this stress
};

/// Which state strains are measured from.
enum class StretchedFrom {
  kRest,   ///< the last output before the light
  kStart,  ///< time 0
};

/// The cells of a load with a traction at these moments, in the order of time. kFile.
Result<std::vector<StretchedCell>> stretched_cells(FinishedRun& run, std::size_t load, const Moments& moments,
                                                   StretchedFrom from = StretchedFrom::kRest);

}  // namespace morula::scenarios
