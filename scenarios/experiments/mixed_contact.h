#pragma once
#include <optional>
#include <vector>

#include "core/parallel/comm.h"
#include "core/result.h"
#include "scenarios/calibrate/mixed_fit.h"
#include "scenarios/experiments/experiment.h"
#include "scenarios/experiments/run_experiments.h"

namespace morula::scenarios {

struct Calibration;

/// Forces of three pairs at one overlap [µm], each the mean of pressing and pulling where both touch [nN].
struct MixedComparison {
  double overlap = 0.0, shells = 0.0, spheres = 0.0, mixed = 0.0;
};

/// How a sphere of a fitted law meets a shell: with factors on its foundation and on W with which the pair of both bodies lies between the pairs of each.
/// Errors are root mean squares in parts of the pull-off force 1.5πWR* (of the largest force, of cells that do not adhere), from δ = −0.5 X to 2 X of the
/// fitted JKR, X = (π²W²R*/E*²)^{1/3}, as far as the shells were pressed and the law holds (fields_and_coupling.md D).
struct MixedContact {
  calibrate::MixedFit fit;
  double misfit = 0.0;                        ///< from halfway between two shells and two spheres, with the fitted factors
  double unfitted = 0.0;                      ///< the same with both factors 1
  double outside = 0.0, outside_worst = 0.0;  ///< beyond the pairs of one body
  std::optional<double> promoted;  ///< way outwards of the twelve neighbours of a sphere that becomes a shell, over R; none: not run
  std::optional<double> held_out;  ///< misfit of pairs of 1 : 1.3, the larger one a sphere and a shell; none: not run
  std::vector<MixedComparison> comparisons;  ///< of equal cells with the fitted factors, for a figure
};

/// The experiments for it, without their texts: trials with several factors, and what shows how good those are that were found.
std::vector<Experiment> mixed_pairs(const CellMaterial& material);

/// Runs them with the sphere that the calibration has found on its root, and fits; outcomes and remarks go to the calibration, `with_shells` to that of the root. Nothing, but
/// a remark, where there are too few of them. Errors: those of run_experiments(). Collective.
Status fit_with_shells(Calibration& calibration, const ExperimentRequest& request, const Comm& comm);

}  // namespace morula::scenarios
