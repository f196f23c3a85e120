#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "scenarios/calibrate/data.h"
#include "scenarios/experiments/found_curves.h"
#include "scenarios/experiments/run_experiments.h"

namespace morula::scenarios {

/// Points for the fit, and what a reader must know of them.
struct ExperimentData {
  calibrate::Data points;
  std::vector<FoundPacking> packings;  ///< of points.packings, in their order
  std::vector<calibrate::Relaxation> relaxations;
  std::vector<FoundCluster> clusters;  ///< of points.clusters, in their order
  std::vector<calibrate::PressedCluster> pressed;
  std::vector<std::uint32_t> pressed_seeds;  ///< of `pressed`
  std::vector<std::string> remarks;          ///< experiments that failed, curves that are not straight in the rate
  double largest_remainder = 0.0;            ///< quadratic part of the force in the rate, over the largest force
};

/// Brings the curves of experiments together. Pairs of the same radii are one experiment at several rates: where they are as far on their way (the
/// distance of the traps), overlap, force and area are extrapolated to no rate; pressing and pulling are two blocks of points. Packings are
/// taken from V/V0 = 1.1 down; where spheres of random packings lie, nobody knows yet (spheres_in_packings.h). Errors (kInput): no pair at two rates. kFile: runs that cannot be read.
Result<ExperimentData> data_of_runs(std::span<const Experiment> experiments, std::span<const ExperimentOutcome> outcomes);

}  // namespace morula::scenarios
