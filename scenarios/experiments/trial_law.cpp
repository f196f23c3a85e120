#include "scenarios/experiments/trial_law.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "study/initial/make_tissue.h"

namespace morula::scenarios {
namespace {

constexpr int kMostSteps = 20000;
// Spheres that move less than this part of R in steps that are so long [s] are at rest.
constexpr double kAtRest = 1e-4, kAtRestStep = 10.0;

}  // namespace

Status come_to_rest(Simulation& simulation, double radius, double end) {
  MORULA_TRY(simulation.first_swaps());
  const auto steps_on = [&]() -> Result<bool> {  // whether they are not at rest yet
    const std::vector<Vec3d> before = simulation.centers();
    const double time = simulation.tissue().clock.time;
    MORULA_TRY(simulation.step(end));
    const std::vector<Vec3d> now = simulation.centers();
    double way = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) way = std::max(way, norm(now[i] - before[i]));
    return way > kAtRest * radius || simulation.tissue().clock.time - time < kAtRestStep;
  };
  int steps = 0;
  for (bool goes_on = true; goes_on && simulation.tissue().clock.time < end; ++steps) {
    if (steps == kMostSteps) return Error{ErrorKind::kPhysics, "spheres on trial find no rest", "calibrate with `--pairs-only`"};
    MORULA_TRY_ASSIGN(goes_on, steps_on());
  }
  return {};
}

Result<std::unique_ptr<Simulation>> spheres_on_trial(const Study& study, const TrialLaw& law, double adhesion_of_shells) {
  Model model = study.model;
  model.types[0].sphere = law.sphere;
  if (adhesion_of_shells > 0.0) model.types[0].sphere.adhesion_factor = law.adhesion / adhesion_of_shells;
  ShapeLibrary shapes;
  MORULA_TRY_ASSIGN(InitialTissue initial, make_tissue(study, shapes, Comm()));
  return Simulation::create(std::move(model), std::move(initial.tissue), Comm(), 1);
}

}  // namespace morula::scenarios
