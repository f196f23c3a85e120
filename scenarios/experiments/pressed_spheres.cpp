#include "scenarios/experiments/pressed_spheres.h"

#include <cmath>
#include <utility>

#include "coupling/simulation.h"
#include "study/initial/make_tissue.h"

namespace morula::scenarios {
namespace {

Result<calibrate::PressedCluster> press_one(const Experiment& experiment, const Study& study, const cbm::SphereParameters& sphere) {
  Model model = study.model;
  model.types[0].sphere = sphere;
  ShapeLibrary shapes;
  MORULA_TRY_ASSIGN(InitialTissue initial, make_tissue(study, shapes, Comm()));
  MORULA_TRY_ASSIGN(auto simulation, Simulation::create(std::move(model), std::move(initial.tissue), Comm(), 1));
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

Result<std::vector<calibrate::PressedCluster>> PressedSpheres::press(const cbm::SphereParameters& sphere, double adhesion) const {
  cbm::SphereParameters own = sphere;
  if (adhesion_ > 0.0) own.adhesion_factor = adhesion / adhesion_;
  std::vector<calibrate::PressedCluster> out;
  for (const Cluster& cluster : clusters_) {
    MORULA_TRY_ASSIGN(auto one, press_one(cluster.experiment, cluster.study, own));
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace morula::scenarios
