#include "scenarios/experiments/spheres_in_clusters.h"

#include <map>
#include <memory>
#include <string>
#include <utility>

namespace morula::scenarios {
namespace {

/// In the order in which a study has its cells.
std::vector<Vec3d> centers_by_id(const Simulation& simulation) {
  const std::vector<Vec3d> by_row = simulation.centers();
  std::map<CellId, Vec3d> by_id;
  for (std::size_t row = 0; row < by_row.size(); ++row) by_id[simulation.tissue().cells.rows[row].id] = by_row[row];
  std::vector<Vec3d> out;
  for (const auto& [id, center] : by_id) out.push_back(center);
  return out;
}

/// The first moment of a study of cells whose spheres are of a law.
Result<std::unique_ptr<Simulation>> start(const CellMaterial& material, const std::string& text, const TrialLaw& law) {
  const auto study = read_study_text("spheres", text, {});
  if (!study.ok()) return Error{ErrorKind::kInternal, "the study of spheres in a cluster is refused: " + study.error().text(), ""};
  MORULA_TRY_ASSIGN(auto simulation, spheres_on_trial(*study, law, material.adhesion));
  MORULA_TRY(simulation->first_swaps());
  return simulation;
}

Status go_on(Simulation& simulation, double end) {
  while (simulation.tissue().clock.time < end) MORULA_TRY(simulation.step(end));
  return {};
}

/// Of the first from the others, the mean [µm].
double distance_from_first(std::span<const Vec3d> centers) {
  double sum = 0.0;
  for (const Vec3d& other : centers.subspan(1)) sum += norm(other - centers.front());
  return sum / static_cast<double>(centers.size() - 1);
}

}  // namespace

Result<double> way_of_promotion(const CellMaterial& material, const TrialLaw& law) {
  const double end = time_of_cluster(material);
  MORULA_TRY_ASSIGN(const auto simulation, start(material, study_of_promotion(material), law));
  MORULA_TRY(go_on(*simulation, end));
  const double before = distance_from_first(centers_by_id(*simulation));
  MORULA_TRY(go_on(*simulation, 2.0 * end));
  return (distance_from_first(centers_by_id(*simulation)) - before) / material.radius;
}

Result<std::vector<RestingCluster>> spheres_in_clusters(const CellMaterial& material, std::span<const FoundCluster> clusters,
                                                        const TrialLaw& law) {
  std::vector<RestingCluster> out;
  for (const FoundCluster& cluster : clusters) {
    MORULA_TRY_ASSIGN(const auto simulation, start(material, study_of_spheres_in_cluster(material, cluster.centers), law));
    MORULA_TRY(go_on(*simulation, time_of_cluster(material)));
    out.push_back({.cells = cluster.centers.size(),
                   .held_out = cluster.held_out,
                   .radius = cluster.radius,
                   .shells = cluster.distance(cluster.centers),
                   .spheres = cluster.distance(centers_by_id(*simulation))});
  }
  return out;
}

}  // namespace morula::scenarios
