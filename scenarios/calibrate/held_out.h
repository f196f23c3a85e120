#pragma once
#include <span>
#include <string>

#include "cbm/packing.h"
#include "scenarios/calibrate/data.h"
#include "scenarios/calibrate/pair_model.h"

namespace morula::calibrate {

/// How wrong a law is about points that it was not fitted to.
struct HeldOutErrors {
  int pairs = 0, packings = 0;
  double force_rms = 0.0, force_worst = 0.0;        ///< over 1.5 πWR* of the fit
  double pressure_rms = 0.0, pressure_worst = 0.0;  ///< over |p|, or over a tenth of the largest |p| of all packings where p is smaller

  /// What two laws are compared by: the larger of both root mean squares.
  [[nodiscard]] double score() const { return force_rms > pressure_rms ? force_rms : pressure_rms; }
};

/// pull_off: 1.5 πW [nN/µm], the pull-off force over R*.
[[nodiscard]] HeldOutErrors held_out_errors(const Data& data, const PairModel& pair, const cbm::PackingCurve& curve, double pull_off);

}  // namespace morula::calibrate
