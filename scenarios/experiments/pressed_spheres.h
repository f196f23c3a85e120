#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/result.h"
#include "scenarios/calibrate/pressed_cluster.h"
#include "scenarios/experiments/experiment.h"
#include "scenarios/experiments/trial_law.h"
#include "study/study.h"

namespace morula::scenarios {

/// Spheres between plates that begin where the shells of pressed clusters do.
class PressedSpheres {
 public:
  /// Clusters of these seeds (pressed_experiment()), which `threads` press side by side. Errors (kInternal): a study of such spheres is refused.
  static Result<PressedSpheres> read(const CellMaterial& material, const std::vector<std::uint32_t>& seeds, int threads);

  /// Work of the plates on spheres of a law, with each of these factors on their friction along contacts. Errors: those of spheres_on_trial() and of a step.
  [[nodiscard]] Result<std::vector<std::vector<calibrate::PressedCluster>>> press(const TrialLaw& law,
                                                                                  std::span<const double> along_factors) const;

 private:
  struct Cluster {
    Experiment experiment;
    Study study;
  };
  [[nodiscard]] Result<calibrate::PressedCluster> press_one(TrialLaw law, double along_factor, const Cluster& cluster) const;

  int threads_ = 1;
  double adhesion_ = 0.0;  // of the shells [nN/µm]
  std::vector<Cluster> clusters_;
};

}  // namespace morula::scenarios
