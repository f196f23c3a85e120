#pragma once
#include <vector>

#include "scenarios/measures/measure.h"

namespace morula::scenarios {

/// A cell pulled at two poles, at one moment.
struct PulledCell {
  double time = 0.0;                 ///< [s]
  double length = 0.0, width = 0.0;  ///< along and across the axis [µm]
};

/// The first cell of a load that pulls, at these moments. kFile.
Result<std::vector<PulledCell>> pulled_cell(FinishedRun& run, const CellLoad& load, const Moments& moments);

/// A recovery held against four measured red cells (rbc_shape_recovery.csv): the time axis is scaled (one viscosity) so that the curve fits
/// the first measured cell best.
struct RecoveryFit {
  double scale = 0.0;    ///< of our times
  double largest = 0.0;  ///< difference of length/width from any of the measured points
};
RecoveryFit fit_recovery(const std::vector<PulledCell>& recovery);

}  // namespace morula::scenarios
