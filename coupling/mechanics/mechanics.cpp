#include "coupling/mechanics/mechanics.h"

#include <algorithm>
#include <utility>

#include "coupling/mechanics/relax.h"
#include "coupling/mechanics/step.h"

namespace morula {

Mechanics::Mechanics(const Model& model, RigidSurfaces obstacles, ShapeLibrary& shapes, Comm comm, int threads)
    : work_(new Workspace{.setting = {model, shapes, comm, threads}, .terms = make_terms(model, std::move(obstacles), threads)}) {}

Mechanics::~Mechanics() = default;
Mechanics::Mechanics(Mechanics&&) noexcept = default;

Mechanics Mechanics::for_another_tissue(Comm comm) const {
  const Workspace::Setting& here = work_->setting;
  return Mechanics(here.model, contacts().shared_obstacles(), here.shapes, comm, here.threads);
}

std::span<const RigidSurface> Mechanics::obstacles() const { return contacts().obstacles(); }

void Mechanics::bodies_changed() {
  work_->age.reset();
  work_->known.reset();
}

void Mechanics::cells_replaced() {
  if (work_->age) work_->age->cells_replaced = true;
  work_->known.reset();
}

void Mechanics::parameters_changed() { work_->known.reset(); }

Result<StepReport, StepFault> Mechanics::step(Tissue& tissue, double dt, std::span<const Vec3d> external, std::span<const Anchor> anchors) {
  return advance(*work_, tissue, {dt, external, anchors});
}

std::vector<Vec3d> Mechanics::random_forces(const Tissue& tissue, double dt) {
  (void)prepare_step(*work_, tissue);
  const std::vector<Vec3d> by_point = morula::random_forces(*work_, tissue, dt);
  std::vector<Vec3d> out(external_size(tissue));
  work_->points().for_all([&](std::uint32_t i) { out[work_->external_place(i)] = by_point[i]; });
  return out;
}

double Mechanics::relax(Tissue& tissue, std::span<const char> moves) { return relax_in_place(*work_, tissue, moves); }
void Mechanics::move_alone(Tissue& tissue, std::span<const char> moves, double step) { march_in_place(*work_, tissue, moves, step); }

std::vector<Vec3d> Mechanics::spread(const Tissue& tissue, std::span<const Vec3d> by_body) {
  prepare_scene(*work_, tissue);
  work_->geometry.update(work_->scene, work_->setting.threads, work_->timer);
  const Scene& scene = work_->scene;
  const SurfaceGeometry& geometry = work_->geometry.now();
  std::vector<Vec3d> out(external_size(tissue));
  const std::size_t shells = scene.owned_shells();
  for (std::size_t i = 0; i < shells; ++i) {
    if (norm2(by_body[i]) == 0.0) continue;
    const ContactBody& body = scene.bodies()[i];
    for (std::uint32_t n = body.first_point; n < body.first_point + body.point_count; ++n)
      out[n] = by_body[i] * (geometry.node_area[n] / geometry.area[i]);
  }
  std::copy(by_body.begin() + static_cast<std::ptrdiff_t>(shells), by_body.end(), out.begin() + scene.owned_nodes());
  return out;
}

std::vector<std::pair<CellId, CellId>> Mechanics::touching(const Tissue& tissue, std::span<const CellId> these) {
  (void)prepare(*work_, tissue);
  const auto bodies = work_->scene.bodies();
  const auto wanted = [&](CellId id) { return std::binary_search(these.begin(), these.end(), id); };
  std::vector<std::pair<CellId, CellId>> out;
  for (const SurfacePair& pair : contacts().pairs()) {
    if (!(pair.area > 0.0) || pair.with_itself()) continue;
    const ContactBody& a = bodies[pair.a];
    const CellId partner = pair.rigid ? CellId(pair.b + 1) : bodies[pair.b].id;
    if (!wanted(a.id) && (pair.rigid || !wanted(partner))) continue;
    if (a.owned) out.emplace_back(a.id, partner);
    if (!pair.rigid && bodies[pair.b].owned) out.emplace_back(partner, a.id);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());  // images of periodic neighbours
  return out;
}

void Mechanics::update_scene(const Tissue& tissue) { (void)prepare(*work_, tissue); }

double Mechanics::energy(const Tissue& tissue) {
  parameters_changed();
  return prepare(*work_, tissue).energy;
}

double Mechanics::known_energy(const Tissue& tissue) { return prepare(*work_, tissue).energy; }

std::size_t Mechanics::external_size(const Tissue& tissue) {
  const auto rigid_nuclei = std::ranges::count_if(tissue.shells.nucleus, [](const auto& center) { return center.has_value(); });
  return tissue.shells.node_count() + tissue.spheres.size() + static_cast<std::size_t>(rigid_nuclei) + tissue.nuclei.shells.node_count();
}

double Mechanics::energy_and_forces(const Tissue& tissue, std::vector<Vec3d>& force) {
  work_->known.reset();
  const Known& known = prepare(*work_, tissue);
  const Scene& scene = work_->scene;
  force.assign(known.force->begin(), known.force->begin() + scene.owned_nodes());
  const auto first = known.force->begin() + scene.sphere_point();
  force.insert(force.end(), first, first + static_cast<std::ptrdiff_t>(scene.owned_spheres()));
  return known.energy;
}

std::vector<Vec3d> Mechanics::net_forces_on(const Tissue& tissue, std::span<const char> wanted) {
  const Settling others_held{{wanted.begin(), wanted.end()}};
  work_->age.reset();
  prepare_scene(*work_, tissue, &others_held);
  return net_forces(tissue);
}

std::vector<Vec3d> Mechanics::net_forces(const Tissue& tissue) {
  std::vector<Vec3d> force;
  (void)energy_and_forces(tissue, force);
  std::vector<Vec3d> out;
  for (std::size_t s = 0; s < tissue.shells.size(); ++s) {
    Vec3d sum{};
    for (const Vec3d& f : std::span(force).subspan(tissue.shells.first_node[s], tissue.shells.nodes(s).size())) sum += f;
    out.push_back(sum);
  }
  out.insert(out.end(), force.end() - static_cast<std::ptrdiff_t>(tissue.spheres.size()), force.end());
  return out;
}

double Mechanics::deepest_overlap() const { return morula::deepest_overlap(*work_); }
dcm::ShellMaterials Mechanics::shell_materials() const { return work_->terms.membranes->shells().materials(); }
dcm::ShellMaterials Mechanics::nucleus_materials() const { return work_->terms.nuclei->materials(); }
StageTimer& Mechanics::timer() { return work_->timer; }
const ContactLayer& Mechanics::contacts() const { return work_->terms.contacts->layer(); }
const Scene& Mechanics::scene() const { return work_->scene; }
dcm::InteriorEnergy Mechanics::interior_of(std::uint32_t shell) const { return work_->terms.interior->of_shell(shell); }
std::optional<NucleusState> Mechanics::nucleus_of(std::uint32_t shell) const { return work_->terms.nuclei->of_shell(shell); }
std::span<const Vec3d> Mechanics::forces_on_nuclei() const { return std::span(*work_->known->force).subspan(work_->scene.nuclear_node()); }
std::size_t Mechanics::memory() const { return std::max(work_->most_bytes, work_->bytes_now()); }

}  // namespace morula
