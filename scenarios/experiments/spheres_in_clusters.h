#pragma once
#include <span>
#include <vector>

#include "core/result.h"
#include "scenarios/experiments/found_curves.h"
#include "scenarios/experiments/trial_law.h"
#include "study/cell_material.h"

namespace morula::scenarios {

/// A cluster of shells that have come together by themselves, and spheres in their place that have.
struct RestingCluster {
  std::size_t cells = 0;
  bool held_out = false;
  double radius = 0.0;   ///< of a free cell [µm]
  double shells = 0.0;   ///< mean distance of neighbours [µm]
  double spheres = 0.0;  ///< of the same pairs [µm]

  [[nodiscard]] double error() const { return (spheres - shells) / radius; }
};

/// Puts spheres of a law where the shells of clusters are and lets them come to rest for as long as shells are given, with the friction of the law. Errors: kInternal, a study of such spheres
/// is refused; those of spheres_on_trial() and Simulation::step().
Result<std::vector<RestingCluster>> spheres_in_clusters(const CellMaterial& material, std::span<const FoundCluster> clusters,
                                                        const TrialLaw& law);

/// How far outwards the twelve neighbours of a sphere of a law move when it becomes a shell, over R: thirteen spheres come to rest, and the one in the middle changes. Errors: those of
/// spheres_in_clusters().
Result<double> way_of_promotion(const CellMaterial& material, const TrialLaw& law);

}  // namespace morula::scenarios
