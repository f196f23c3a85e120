// Shells whose nodes have drifted together get an even mesh on the same surface: the mesh of the library with its nodes spread, or one of their own.
#include "core/mesh/renewal/onto_ball.h"
#include "core/mesh/renewal/own_mesh.h"
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

/// Meshes of the library are looked at every so many steps; those of a shell's own, whose passes do little each, at every step.
constexpr std::uint64_t kStepsBetweenLooks = 5;
/// Neighbours farther away than this are not reached by the new surface [µm].
constexpr double kReach = 1.0;
/// A renewal is worth the trouble when its worst face gains this quality.
constexpr double kLeastGain = 0.05;
/// Most that the new surface is off the old one, in mean edges.
constexpr double kMostDistance = 0.25;
/// Elongation beyond which the connectivity of a ball is left at once: an aspect of 4 (decision 0057).
constexpr double kRod = 3.4;
/// Elongation below which a shell tries to go back to it: an aspect of 2.
constexpr double kBall = 1.8;
/// Quality above `renew_mesh_below` that the mesh of the library must have after going back, so that it is not left again at once.
constexpr double kLeastOfReturn = 0.05;
/// A pass that gains less than this, and is not good enough, is not followed by another one for a while.
constexpr double kGainOfPass = 0.01;
/// For so long [s].
constexpr double kTimeBetweenPasses = 20.0;
/// A shell of the library whose nodes could not be spread, but which has another way, tries to spread them again after this time [s].
constexpr double kTimeToSpreadAgain = 60.0;

/// A shell that is looked at, and its new mesh. At most one of the meshes is there.
struct Renewal {
  BodyOfRow body{};
  double quality = 0.0;                  ///< of its worst face
  bool has_own = false;                  ///< it has left the library's connectivity
  bool try_library = false;              ///< on the library's connectivity: to spread the nodes, or to go back to it
  bool try_own = false;                  ///< if that does not serve
  std::optional<RenewedSurface> mesh{};  ///< on the library's connectivity
  std::optional<OwnMesh> own{};
};

/// The shells that need another mesh or may have a better one.
std::vector<Renewal> shells_to_renew(const Model& model, const Tissue& tissue) {
  std::vector<Renewal> out;
  const bool looks_at_all = tissue.clock.steps % kStepsBetweenLooks == 0;
  const auto told = [&](std::size_t variable, std::size_t row) { return tissue.cells.variables[variable].values[row]; };
  const std::size_t next_try = mesh_renewal_variable(model, MeshRenewal::kNextTry);
  const double now = tissue.clock.time;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    const CellType& type = model.types[tissue.cells.rows[body.row].type];
    if (!body.is_shell || !(type.renew_mesh_below > 0.0)) continue;
    const bool has_own = type.own_mesh && tissue.shells.shape[body.number]->icosphere_nodes == 0;
    if (!looks_at_all && !has_own) continue;
    const SurfaceView surface{tissue.shells.nodes(body.number), &tissue.shells.topology(body.number)};
    Renewal one{body, least_quality(surface.topology->faces(), surface.position), has_own};
    const bool is_uneven = one.quality < type.renew_mesh_below;
    const bool may_own = type.own_mesh && now >= told(own_mesh_variable(model, OwnMeshRenewal::kNextPass), body.row);
    one.try_own = is_uneven && may_own;
    if (now >= told(next_try, body.row)) {
      if (one.has_own)
        one.try_library = elongation(surface) < kBall;
      else
        one.try_library = is_uneven && !(type.own_mesh && elongation(surface) > kRod);
    }
    if (one.try_library || one.try_own) out.push_back(std::move(one));
  }
  return out;
}

/// The shell on a mesh that stands for its surface: body and nucleus stay, nodes, edges and faces follow the rules of their columns.
dcm::ShellRecord on_new_mesh(const dcm::ShellRecord& old, const AskedSurface& surface, std::shared_ptr<const ReferenceShape> shape,
                             std::span<const Vec3d> position, bool of_triangles) {
  std::vector<std::uint32_t> same(old.shape->topology->face_count());
  std::iota(same.begin(), same.end(), 0u);
  const NewMesh mesh{old, surface, same, *shape, position};
  dcm::ShellRecord out = old;
  carry_columns(mesh, 1.0, out);
  out.rest_length = carried_rest_lengths(mesh, of_triangles);
  out.position.assign(position.begin(), position.end());
  out.shape = std::move(shape);
  return out;
}

/// The shell with its new mesh of either kind.
dcm::ShellRecord renewed_shell(const dcm::ShellRecord& old, const Renewal& renewal, const CellType& type, ShapeLibrary& shapes) {
  const AskedSurface surface(SurfaceView{old.position, old.shape->topology.get()});
  const bool is_elastic = dcm::has_elastic_surface(type.shell);
  auto shape = renewal.own        ? shapes.adopt(carried_shape(old, surface, renewal.own->topology, renewal.own->position, is_elastic))
               : !renewal.has_own ? old.shape
                                  : shapes.icosphere(type.shell_nodes).value();
  dcm::ShellRecord out =
      on_new_mesh(old, surface, shape, renewal.mesh ? renewal.mesh->position : renewal.own->position, dcm::strains_faces(type.shell));
  if (!is_elastic) out.rest_length = free_rest_lengths(*out.shape, out.rest_volume);  // a fluid forgets
  return out;
}

/// Finds the new meshes; nothing is changed yet.
void find_mesh(const Model& model, const Tissue& tissue, const Surroundings& around, const ReferenceShape* ball, Renewal& one) {
  const std::size_t shell = one.body.number;
  const CellType& type = model.types[tissue.cells.rows[one.body.row].type];
  const SurfaceView surface{tissue.shells.nodes(shell), &tissue.shells.topology(shell)};
  if (one.try_library) {
    auto renewed =
        one.has_own ? onto_ball(surface, around.surfaces, *ball,
                                {.least_quality = type.renew_mesh_below + kLeastOfReturn, .most_distance = kMostDistance})
                    : redistribute(surface, around.surfaces, {.least_quality = one.quality + kLeastGain, .most_distance = kMostDistance});
    if (renewed.ok()) {
      one.mesh = std::move(renewed).value();
      return;
    }
  }
  if (!one.try_own) return;
  auto own = renew_connectivity(surface, around.surfaces, {.nodes = type.shell_nodes});
  if (own.ok()) one.own = std::move(own).value();
}

/// Tells in the variables of a cell what was done and what was not.
void tell(const Model& model, const Renewal& one, double now, CellState& row) {
  const auto variable = [&](MeshRenewal which) -> double& { return row.variables[mesh_renewal_variable(model, which)]; };
  const auto of_own = [&](OwnMeshRenewal which) -> double& { return row.variables[own_mesh_variable(model, which)]; };
  const auto at_least = [](double& value, double now_told) { value = std::max(value, now_told); };
  const double below = model.types[row.type].renew_mesh_below;
  if (one.mesh) {
    const RenewalReport& report = one.mesh->report;
    (one.has_own ? of_own(OwnMeshRenewal::kReturns) : variable(MeshRenewal::kDone)) += 1.0;
    at_least(variable(MeshRenewal::kArea), std::abs(report.area_change));
    at_least(variable(MeshRenewal::kDistance), report.distance.largest() / report.mean_edge);
  }
  if (one.try_library && (!one.mesh || one.mesh->report.least_quality < below))
    variable(MeshRenewal::kNextTry) = now + (model.types[row.type].own_mesh && !one.has_own ? kTimeToSpreadAgain : kTimeBetweenTries);
  if (one.own) {
    const OwnMeshReport& report = one.own->report;
    of_own(OwnMeshRenewal::kPasses) += 1.0;
    of_own(OwnMeshRenewal::kChanges) += report.splits + report.collapses + report.flips;
    of_own(OwnMeshRenewal::kSkipped) += report.skipped();
    at_least(of_own(OwnMeshRenewal::kArea), std::abs(report.area_change));
    at_least(of_own(OwnMeshRenewal::kVolume), std::abs(report.volume_error));
    at_least(of_own(OwnMeshRenewal::kOff), report.off_surface / report.mean_edge);
  }
  const bool gained = one.own && (one.own->report.least_quality >= below || one.own->report.least_quality > one.quality + kGainOfPass);
  if (one.try_own && !one.mesh && !gained) of_own(OwnMeshRenewal::kNextPass) = now + kTimeBetweenPasses;
}

}  // namespace

void Simulation::renew_meshes(std::vector<Event>& events) {
  const auto renews = [](const CellType& type) { return type.renew_mesh_below > 0.0; };
  if (std::ranges::none_of(model_.types, renews)) return;
  const bool any_own = std::ranges::any_of(model_.types, [](const CellType& type) { return type.own_mesh; });
  if (!any_own && tissue_.clock.steps % kStepsBetweenLooks != 0) return;
  auto timed = timer().scope(Stage::kBehaviours);
  std::vector<Renewal> found = shells_to_renew(model_, tissue_);
  if (!comm_.any(!found.empty())) return;
  mechanics_->update_scene(tissue_);
  std::vector<std::shared_ptr<const ReferenceShape>> ball;  // by type
  for (const CellType& type : model_.types) ball.push_back(shapes_.icosphere(type.shell_nodes).value());
  parallel_for(threads_, found.size(), [&](std::size_t k) {
    Surroundings around = surroundings_of(mechanics_->scene(), model_.space, found[k].body.number, kReach);
    add_obstacles(mechanics_->obstacles(), tissue_.obstacle_offset, model_.space, tissue_.shells.nodes(found[k].body.number), kReach,
                  around);
    find_mesh(model_, tissue_, around, ball[tissue_.cells.rows[found[k].body.row].type].get(), found[k]);
  });

  std::vector<std::size_t> rows;
  std::vector<CellRecord> renewed;
  for (const Renewal& one : found) {
    CellRecord cell = record_of(tissue_, one.body);
    tell(model_, one, tissue_.clock.time, cell.row);
    if (one.mesh || one.own) {
      cell.shell = renewed_shell(*cell.shell, one, model_.types[cell.row.type], shapes_);
    } else if (one.quality < model_.types[cell.row.type].renew_mesh_below) {
      double& refused = cell.row.variables[mesh_renewal_variable(model_, MeshRenewal::kRefused)];
      if ((refused += 1.0) == 1.0)
        events.push_back({tissue_.clock.time, EventKind::kWarning, cell.row.id, {}, {}, {EventReason::Cause::kUnevenMesh}});
    }
    rows.push_back(one.body.row);
    renewed.push_back(std::move(cell));
  }
  replace_cells(tissue_, rows, std::move(renewed));
  mechanics_->cells_replaced();
}

}  // namespace morula
