#pragma once
#include <memory>

#include "cbm/spheres.h"
#include "core/result.h"
#include "coupling/simulation.h"
#include "scenarios/calibrate/packing_geometry.h"
#include "study/study.h"

namespace morula::scenarios {

/// A law of spheres on trial.
struct TrialLaw {
  cbm::SphereParameters sphere;  ///< with its curve of packing
  double adhesion = 0.0;         ///< W of two of them [nN/µm]
  calibrate::PairModel pair;     ///< what `sphere` is for an attached pair, without packing

  /// The same with what packing adds to two that nobody else touches.
  [[nodiscard]] calibrate::PairModel of_two() const { return calibrate::with_packing(pair, sphere.packing); }
};

/// A simulation of the first moment of a study whose one type has spheres of a law on trial, in place of shells that adhere with `adhesion_of_shells` [nN/µm]. One rank
/// and thread. Errors: those of make_tissue() and Simulation::create().
Result<std::unique_ptr<Simulation>> spheres_on_trial(const Study& study, const TrialLaw& law, double adhesion_of_shells);

}  // namespace morula::scenarios
