#pragma once
#include <vector>

#include "cbm/packing.h"
#include "scenarios/calibrate/data.h"
#include "scenarios/calibrate/pair_model.h"

namespace morula::calibrate {

/// A packing that a law was not fitted to.
struct HeldOutPacking {
  Arrangement arrangement = Arrangement::kRandom;
  double volume_ratio = 1.0;  ///< V/V0
  double pressure = 0.0;      ///< of the shells [kPa]
  double by_law = 0.0;        ///< of spheres with the law [kPa]
};

/// How wrong a law is about points that it was not fitted to.
struct HeldOutErrors {
  int pairs = 0, packings = 0, lattices = 0;
  double force_rms = 0.0, force_worst = 0.0;        ///< over 1.5 πWR* of the fit
  double pressure_rms = 0.0, pressure_worst = 0.0;  ///< of random packings, over |p|, or over a tenth of the largest |p| where p is smaller
  double lattice_rms = 0.0, lattice_worst = 0.0;    ///< of cubic packings, likewise
  std::vector<HeldOutPacking> all_packings;         ///< of either

  /// What two laws are compared by: the larger root mean square of pairs and random packings, which is what tissues are.
  [[nodiscard]] double score() const { return force_rms > pressure_rms ? force_rms : pressure_rms; }
};

/// pull_off: 1.5 πW [nN/µm], the pull-off force over R*.
[[nodiscard]] HeldOutErrors held_out_errors(const Data& data, const PairModel& pair, const cbm::PackingCurve& curve, double pull_off);

}  // namespace morula::calibrate
