#include "scenarios/experiments/trial_law.h"

#include <utility>

#include "study/initial/make_tissue.h"

namespace morula::scenarios {

Result<std::unique_ptr<Simulation>> spheres_on_trial(const Study& study, const TrialLaw& law, double adhesion_of_shells) {
  Model model = study.model;
  model.types[0].sphere = law.sphere;
  if (adhesion_of_shells > 0.0) model.types[0].sphere.adhesion_factor = law.adhesion / adhesion_of_shells;
  ShapeLibrary shapes;
  MORULA_TRY_ASSIGN(InitialTissue initial, make_tissue(study, shapes, Comm()));
  return Simulation::create(std::move(model), std::move(initial.tissue), Comm(), 1);
}

}  // namespace morula::scenarios
