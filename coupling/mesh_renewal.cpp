// Shells whose nodes have drifted together get an even mesh on the same surface.
#include "core/mesh/renewal/renew_surface.h"
#include "core/parallel/threads.h"
#include "coupling/behaviours/life.h"
#include "coupling/cell_record.h"
#include "coupling/cell_variables.h"
#include "coupling/new_mesh.h"
#include "coupling/simulation.h"
#include "coupling/surroundings.h"

#include <algorithm>
#include <numeric>

namespace morula {
namespace {

/// Meshes are looked at every so many steps.
constexpr std::uint64_t kStepsBetweenLooks = 5;
/// Neighbours farther away than this are not reached by the new surface [µm].
constexpr double kReach = 1.0;
/// A renewal is worth the trouble when its worst face gains this quality.
constexpr double kLeastGain = 0.05;
/// Most that the new surface is off the old one, in mean edges.
constexpr double kMostDistance = 0.25;

/// A shell with an uneven mesh, and its new one.
struct Renewal {
  BodyOfRow body{};
  double quality = 0.0;  ///< of its worst face
  std::optional<RenewedSurface> mesh;
};

std::vector<Renewal> uneven_shells(const Model& model, const Tissue& tissue) {
  std::vector<Renewal> out;
  const auto& next_try = tissue.cells.variables[mesh_renewal_variable(model, MeshRenewal::kNextTry)].values;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    const double below = model.types[tissue.cells.rows[body.row].type].renew_mesh_below;
    if (!body.is_shell || !(below > 0.0) || tissue.clock.time < next_try[body.row]) continue;
    const double quality = least_quality(tissue.shells.topology(body.number).faces(), tissue.shells.nodes(body.number));
    if (quality < below) out.push_back({body, quality, std::nullopt});
  }
  return out;
}

/// The shell on its new mesh: body and nucleus stay, nodes, edges and faces follow the rules of their columns.
dcm::ShellRecord on_new_mesh(const dcm::ShellRecord& old, const RenewedSurface& renewed) {
  const AskedSurface surface(SurfaceView{old.position, old.shape->topology.get()});
  std::vector<std::uint32_t> same(old.shape->topology->face_count());
  std::iota(same.begin(), same.end(), 0u);
  const NewMesh mesh{old, surface, same, *old.shape, renewed.position};
  dcm::ShellRecord out = old;
  carry_columns(mesh, 1.0, out);
  out.rest_length = carried_rest_lengths(mesh);
  out.position = renewed.position;
  return out;
}

}  // namespace

void Simulation::renew_meshes(std::vector<Event>& events) {
  const auto renews = [](const CellType& type) { return type.renew_mesh_below > 0.0; };
  if (tissue_.clock.steps % kStepsBetweenLooks != 0 || std::ranges::none_of(model_.types, renews)) return;
  auto timed = timer().scope(Stage::kBehaviours);
  std::vector<Renewal> uneven = uneven_shells(model_, tissue_);
  if (!comm_.any(!uneven.empty())) return;
  mechanics_->update_scene(tissue_);
  parallel_for(threads_, uneven.size(), [&](std::size_t k) {
    const std::size_t shell = uneven[k].body.number;
    const Surroundings around = surroundings_of(mechanics_->scene(), model_.space, shell, kReach);
    auto renewed = redistribute({tissue_.shells.nodes(shell), &tissue_.shells.topology(shell)}, around.surfaces,
                                {.least_quality = uneven[k].quality + kLeastGain, .most_distance = kMostDistance});
    if (renewed.ok()) uneven[k].mesh = std::move(renewed).value();
  });

  std::vector<std::size_t> rows;
  std::vector<CellRecord> renewed;
  for (const Renewal& one : uneven) {
    CellRecord cell = record_of(tissue_, one.body);
    const auto variable = [&](MeshRenewal which) -> double& { return cell.row.variables[mesh_renewal_variable(model_, which)]; };
    const double below = model_.types[cell.row.type].renew_mesh_below;
    if (one.mesh) {
      const RenewalReport& report = one.mesh->report;
      cell.shell = on_new_mesh(*cell.shell, *one.mesh);
      variable(MeshRenewal::kDone) += 1.0;
      variable(MeshRenewal::kArea) = std::max(variable(MeshRenewal::kArea), std::abs(report.area_change));
      variable(MeshRenewal::kDistance) = std::max(variable(MeshRenewal::kDistance), report.distance.largest() / report.mean_edge);
    } else if ((variable(MeshRenewal::kRefused) += 1.0) == 1.0) {
      events.push_back({tissue_.clock.time, EventKind::kWarning, cell.row.id, {}, {}, {EventReason::Cause::kUnevenMesh}});
    }
    if (!one.mesh || one.mesh->report.least_quality < below) variable(MeshRenewal::kNextTry) = tissue_.clock.time + kTimeBetweenTries;
    rows.push_back(one.body.row);
    renewed.push_back(std::move(cell));
  }
  replace_cells(tissue_, rows, std::move(renewed));
  mechanics_->cells_replaced();
}

}  // namespace morula
