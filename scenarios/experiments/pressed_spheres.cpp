#include "scenarios/experiments/pressed_spheres.h"

#include <cmath>
#include <memory>
#include <utility>

namespace morula::scenarios {
namespace {

Result<calibrate::PressedCluster> press_one(const Experiment& experiment, std::unique_ptr<Simulation> simulation) {
  std::vector<double> part, force;
  for (int k = 0; k <= kPressedOutputs; ++k) {
    part.push_back(static_cast<double>(k) / kPressedOutputs);
    const double moment = experiment.turn + part.back() * experiment.pressing;
    while (simulation->tissue().clock.time < moment) MORULA_TRY(simulation->step(moment));
    double sum = 0.0;
    for (const Vec3d& on_plate : simulation->mechanics().obstacle_forces(simulation->tissue())) sum += 0.5 * std::abs(on_plate.z);
    force.push_back(sum);
  }
  return calibrate::pressed_cluster(std::move(part), force, experiment.way);
}

}  // namespace

Result<PressedSpheres> PressedSpheres::read(const CellMaterial& material, const std::vector<std::uint32_t>& seeds) {
  PressedSpheres out;
  out.adhesion_ = material.adhesion;
  for (const std::uint32_t seed : seeds) {
    Experiment experiment = pressed_spheres_experiment(material, seed);
    auto study = read_study_text("spheres", experiment.text, {});
    if (!study.ok()) return Error{ErrorKind::kInternal, "the study of spheres between plates is refused: " + study.error().text(), ""};
    out.clusters_.push_back({std::move(experiment), std::move(study).value()});
  }
  return out;
}

Result<std::vector<calibrate::PressedCluster>> PressedSpheres::press(const TrialLaw& law) const {
  std::vector<calibrate::PressedCluster> out;
  for (const auto& [experiment, study] : clusters_) {
    MORULA_TRY_ASSIGN(auto spheres, spheres_on_trial(study, law, adhesion_));
    MORULA_TRY_ASSIGN(auto one, press_one(experiment, std::move(spheres)));
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace morula::scenarios
