#include "scenarios/experiments/pressed_spheres.h"

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "core/parallel/threads.h"

namespace morula::scenarios {
namespace {

Result<calibrate::PressedCluster> work_of_plates(const Experiment& experiment, std::unique_ptr<Simulation> simulation) {
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

Result<PressedSpheres> PressedSpheres::read(const CellMaterial& material, const std::vector<std::uint32_t>& seeds, int threads) {
  PressedSpheres out;
  out.threads_ = threads;
  out.adhesion_ = material.adhesion;
  for (const std::uint32_t seed : seeds) {
    Experiment experiment = pressed_spheres_experiment(material, seed);
    auto study = read_study_text("spheres", experiment.text, {});
    if (!study.ok()) return Error{ErrorKind::kInternal, "the study of spheres between plates is refused: " + study.error().text(), ""};
    out.clusters_.push_back({std::move(experiment), std::move(study).value()});
  }
  return out;
}

Result<calibrate::PressedCluster> PressedSpheres::press_one(TrialLaw law, double along_factor, const Cluster& cluster) const {
  law.sphere.along_factor = along_factor;
  MORULA_TRY_ASSIGN(auto spheres, spheres_on_trial(cluster.study, law, adhesion_));
  return work_of_plates(cluster.experiment, std::move(spheres));
}

Result<std::vector<std::vector<calibrate::PressedCluster>>> PressedSpheres::press(const TrialLaw& law,
                                                                                  std::span<const double> along_factors) const {
  const std::size_t clusters = clusters_.size();
  std::vector<std::optional<Result<calibrate::PressedCluster>>> pressed(along_factors.size() * clusters);
  one_by_one(threads_, pressed.size(),
             [&](std::size_t k) { pressed[k] = press_one(law, along_factors[k / clusters], clusters_[k % clusters]); });
  std::vector<std::vector<calibrate::PressedCluster>> out(along_factors.size());
  for (std::size_t k = 0; k < pressed.size(); ++k) {
    MORULA_TRY_ASSIGN(auto one, std::move(*pressed[k]));
    out[k / clusters].push_back(std::move(one));
  }
  return out;
}

}  // namespace morula::scenarios
