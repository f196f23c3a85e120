/// What mechanics tells of each cell: volume, area, stress and pressure, contact; and of obstacles (decisions 0023, 0054).
#include <cmath>
#include <limits>

#include "core/ball.h"
#include "core/parallel/threads.h"
#include "core/virial.h"
#include "coupling/loads/loads.h"
#include "coupling/lumens.h"
#include "coupling/mechanics/mechanics.h"
#include "coupling/mechanics/workspace.h"

namespace morula {
namespace {

double trace(const SymMat3<double>& m) { return m.xx + m.yy + m.zz; }

/// What loads, grips and the fluid of cavities exert on the nodes of the rank's shells at the tissue's time [nN]; empty: nothing. Collective.
std::vector<Vec3d> load_forces(const Model& model, const Tissue& tissue, const Comm& comm) {
  std::vector<Vec3d> out;
  if (model.loads.empty() && tissue.lumens.empty()) return out;
  out.resize(tissue.shells.node_count());
  add_surface_loads(model, tissue, tissue.clock.time, LoadsThat::kAll, out);
  add_lumen_forces(model, tissue, tissue.clock.time, comm, out);
  for (const Anchor& anchor : grip_anchors(model, tissue, tissue.clock.time)) add_pull(anchor, tissue, out);
  return out;
}

/// What contacts have of the virial of a shell's nodes though no neighbour bears it (SurfacePair::within), by owned shell [nN·µm].
std::vector<SymMat3<double>> virials_within_contacts(const Workspace& work, std::span<const SphereTouch> touches) {
  const Scene& scene = work.scene;
  std::vector<SymMat3<double>> out(scene.owned_shells());
  const auto add = [&](std::uint32_t body, const SymMat3<float>& m) {
    if (body < out.size()) out[body] += {m.xx, m.xy, m.xz, m.yy, m.yz, m.zz};
  };
  for (const SurfacePair& pair : work.terms.contacts->layer().pairs()) {
    add(pair.a, pair.within[0]);
    if (!pair.rigid) add(pair.b, pair.within[1]);
  }
  for (const SphereTouch& touch : touches)  // a sphere bears the surface in one place
    if (touch.surface < out.size()) out[touch.surface] += virial_of(touch.place, touch.force);
  return out;
}

/// The V of the stress of each owned shell: what it would be if facets with spheres were flat. One force in the middle of such a facet stands for a pressure on
/// it, whose virial is that on a plane there [µm³].
std::vector<double> stressed_volumes_of_shells(const Workspace& work, std::span<const SphereTouch> touches) {
  const auto& volume = work.geometry.now().volume;
  std::vector<double> out(volume.begin(), volume.begin() + static_cast<std::ptrdiff_t>(work.scene.owned_shells()));
  for (const SphereTouch& touch : touches)
    if (touch.surface < out.size()) out[touch.surface] += touch.bulge;
  return out;
}

std::vector<SymMat3<double>> stresses_of_shells(const Workspace& work, const Tissue& tissue, std::span<const SphereTouch> touches) {
  const std::vector<Vec3d> loads = load_forces(work.setting.model, tissue, work.setting.comm);
  const Scene& scene = work.scene;
  std::vector<SymMat3<double>> out = virials_within_contacts(work, touches);
  const std::vector<double> volume = stressed_volumes_of_shells(work, touches);
  const std::span<const Vec3d> x = scene.position(), of_contacts = work.terms.contacts->found().force;
  parallel_for(work.setting.threads, out.size(), [&](std::size_t i) {
    const ContactBody& body = scene.bodies()[i];
    const Vec3d center = volume_centroid(scene.topologies()[i]->faces(), x.subspan(body.first_point, body.point_count));
    SymMat3<double> sum;
    for (std::uint32_t n = body.first_point; n < body.first_point + body.point_count; ++n)
      sum += virial_of(x[n] - center, loads.empty() ? of_contacts[n] : of_contacts[n] + loads[n]);
    out[i] = (1.0 / volume[i]) * (sum + -1.0 * out[i]);
  });
  return out;
}

/// What touches spheres beside spheres: surfaces, and the fluid of cavities in the middle of what it touches of each, which is no surface's.
std::vector<SphereTouch> touches_of_spheres(const Workspace& work, const Tissue& tissue) {
  std::vector<SphereTouch> out = work.terms.contacts->layer().touches_of_spheres(contact_scene(work.scene, work.geometry.now()));
  const std::vector<Vec3d> push = pushes_on_spheres(work.setting.model, tissue, tissue.clock.time);
  for (std::size_t i = 0; i < push.size(); ++i)
    if (norm2(push[i]) > 0.0)
      out.push_back({.sphere = static_cast<std::uint32_t>(work.scene.first_sphere() + i),
                     .surface = std::numeric_limits<std::uint32_t>::max(),
                     .place = normalized(push[i]) * -tissue.spheres.radius[i],
                     .force = push[i]});
  return out;
}

std::vector<double> pressures_from(const Workspace& work, const Tissue& tissue, std::span<const SymMat3<double>> of_shells,
                                   std::span<const SphereTouch> touches) {
  const Scene& scene = work.scene;
  std::vector<double> out;
  for (const SymMat3<double>& stress : of_shells) out.push_back(-trace(stress) / 3.0);
  std::vector<double> virial(scene.owned_spheres());
  for (std::size_t i = 0; i < virial.size(); ++i) virial[i] = work.terms.spheres->virial(i);
  for (const SphereTouch& touch : touches)
    if (scene.bodies()[touch.sphere].owned) virial[touch.sphere - scene.first_sphere()] -= dot(touch.place, touch.force);
  out.resize(of_shells.size() + virial.size());
  parallel_for(work.setting.threads, virial.size(), [&](std::size_t i) {
    out[of_shells.size() + i] = cbm::sphere_pressure(virial[i], ball_volume(tissue.spheres.radius[i]),
                                                     work.setting.model.types[tissue.spheres.type[i]].shell.bulk_modulus);
  });
  return out;
}

/// Of the spheres: volumes, areas, contact and stress, whose pressures are known.
void add_values_of_spheres(const Workspace& work, const Tissue& tissue, std::span<const SphereTouch> touches, BodyValues& values) {
  const Scene& scene = work.scene;
  const std::size_t shells = scene.owned_shells();
  std::vector<SphereContacts::Pressing> pressing = work.terms.spheres->pressing(scene);
  for (const SphereTouch& touch : touches) {
    if (!scene.bodies()[touch.sphere].owned) continue;
    SphereContacts::Pressing& sum = pressing[touch.sphere - scene.first_sphere()];
    sum.with_cells += touch.area;
    sum.virial += virial_of(touch.place, touch.force * -1.0);
  }
  for (std::size_t i = 0; i < scene.owned_spheres(); ++i) {
    const CellType& type = work.setting.model.types[tissue.spheres.type[i]];
    const double r = tissue.spheres.radius[i], modulus = type.shell.bulk_modulus, surface = ball_surface(r);
    values.volume[shells + i] = ball_volume(r);
    values.area[shells + i] = surface;
    values.contact_area[shells + i] = surface * type.sphere.crowded_area.at(pressing[i].with_cells / surface) + pressing[i].with_obstacles;
    values.stressed_volume[shells + i] = cbm::pressed_volume(values.pressure[shells + i], ball_volume(r), modulus);
    values.stress[shells + i] = (-1.0 / values.stressed_volume[shells + i]) * pressing[i].virial;
  }
}

}  // namespace

void Mechanics::attach(Tissue& tissue) {
  (void)prepare(*work_, tissue);
  if (work_->setting.comm.any(work_->terms.spheres->update_attached(work_->world(tissue), tissue))) work_->known.reset();
}

void Mechanics::look(const Tissue& tissue) {
  (void)prepare(*work_, tissue);
  SphereContacts& spheres = *work_->terms.spheres;
  const World world = work_->world(tissue);
  using Renewed = SphereContacts::Renewed;
  const Renewed supports = spheres.renew_supports(world), sisters = spheres.renew_sisters(world);
  const auto renewed = static_cast<Renewed>(work_->setting.comm.max(static_cast<std::int64_t>(std::max(supports, sisters))));
  // Packing counts at the neighbours, too. The forces are those of a step from here on, whose sisters are the same.
  if (spheres.packs() && renewed == Renewed::kPacking) {
    Evaluation now = evaluate(*work_, tissue, {});
    work_->known = Known{now.energy, std::move(now.force)};
  } else if (renewed != Renewed::kNothing) {
    work_->known.reset();
  }
}

std::vector<double> Mechanics::pressures(const Tissue& tissue) {
  look(tissue);
  const std::vector<SphereTouch> touches = touches_of_spheres(*work_, tissue);
  return pressures_from(*work_, tissue, stresses_of_shells(*work_, tissue, touches), touches);
}

BodyValues Mechanics::values(const Tissue& tissue) {
  look(tissue);
  const Workspace& work = *work_;
  const std::vector<SphereTouch> touches = touches_of_spheres(work, tissue);
  BodyValues values;
  values.stress = stresses_of_shells(work, tissue, touches);
  values.pressure = values.inner_pressure = pressures_from(work, tissue, values.stress, touches);
  const std::size_t shells = work.scene.owned_shells(), spheres = work.scene.owned_spheres();
  values.stressed_volume = stressed_volumes_of_shells(work, touches);
  values.stress.resize(shells + spheres);
  values.stressed_volume.resize(shells + spheres);
  for (auto* v : {&values.volume, &values.area, &values.contact_area}) v->assign(shells + spheres, 0.0);
  for (std::size_t i = 0; i < shells; ++i) {
    values.volume[i] = work.geometry.now().volume[i];
    values.area[i] = work.geometry.now().area[i];
    values.inner_pressure[i] = work.terms.membranes->found().pressure[i];
  }
  parallel_for(work.setting.threads, shells, [&](std::size_t i) {
    values.contact_area[i] =
        work.terms.contacts->found().contact_area(work.scene.topologies()[i]->faces(), tissue.shells.nodes(i), work.scene.first_face()[i]);
  });
  add_values_of_spheres(work, tissue, touches, values);
  return values;
}

SphereRangeCount Mechanics::contacts_beyond_range() const { return work_->terms.spheres->count_beyond_range(work_->scene); }

std::vector<double> Mechanics::packing() const {
  std::vector<double> out(work_->scene.owned_spheres());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = work_->terms.spheres->packing(i);
  return out;
}

std::vector<Vec3d> Mechanics::obstacle_forces(const Tissue& tissue) {
  std::vector<Vec3d> out(work_->setting.model.obstacles.size());
  if (out.empty()) return out;
  (void)prepare(*work_, tissue);
  std::vector<OrderFreeSum> sums(3 * out.size());
  const auto add = [&](std::uint32_t obstacle, const Vec3d& force) {
    if (obstacle >= out.size()) return;  // walls of the domain come after the obstacles
    for (std::size_t axis = 0; axis < 3; ++axis) sums[3 * obstacle + axis].add(force[axis]);
  };
  for (const SurfacePair& pair : contacts().pairs())
    if (pair.rigid && work_->scene.bodies()[pair.a].owned) add(pair.b, pair.push);
  work_->terms.spheres->for_pushed_obstacles([&](std::uint32_t, std::uint32_t obstacle, const Vec3d& force) { add(obstacle, force); });
  std::vector<double> totals(sums.size());
  work_->setting.comm.sum(sums, totals);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {totals[3 * i], totals[3 * i + 1], totals[3 * i + 2]};
  return out;
}

}  // namespace morula
