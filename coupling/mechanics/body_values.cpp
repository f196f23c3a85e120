/// What mechanics tells of each cell: volume, area, stress and pressure, contact; and of obstacles (decision 0023).
#include <cmath>
#include <numbers>

#include "core/parallel/threads.h"
#include "coupling/loads.h"
#include "coupling/lumens.h"
#include "coupling/mechanics/mechanics.h"

namespace morula {
namespace {

/// Symmetric part of a ⊗ b.
SymMat3<double> symmetric(const Vec3d& a, const Vec3d& b) {
  return {a.x * b.x, 0.5 * (a.x * b.y + a.y * b.x), 0.5 * (a.x * b.z + a.z * b.x), a.y * b.y, 0.5 * (a.y * b.z + a.z * b.y), a.z * b.z};
}

double ball(double radius) { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }

double trace(const SymMat3<double>& m) { return m.xx + m.yy + m.zz; }

/// What loads, grips and the fluid of cavities exert on the nodes of the rank's shells at the tissue's time [nN]; empty: nothing. Collective.
std::vector<Vec3d> load_forces(const Model& model, const Tissue& tissue, const Comm& comm) {
  std::vector<Vec3d> out;
  if (model.loads.empty() && tissue.lumens.empty()) return out;
  out.resize(tissue.shells.node_count());
  add_surface_loads(model, tissue, tissue.clock.time, out);
  add_lumen_forces(model, tissue, tissue.clock.time, comm, out);
  for (const Anchor& anchor : grip_anchors(model, tissue, tissue.clock.time))
    out[anchor.node] += (anchor.target - tissue.shells.position[anchor.node]) * anchor.stiffness;
  return out;
}

}  // namespace

void Mechanics::attach(Tissue& tissue) {
  prepare(tissue);
  if (comm_.any(spheres_.update_attached(scene_, contacts_, tissue))) evaluated_ = false;
}

void Mechanics::look(const Tissue& tissue) {
  prepare(tissue);
  const bool renewed = spheres_.renew_sisters(scene_, contacts_, tissue.clock.time);
  if (renewed) flags_changed_ = true;
  if (spheres_.packs() && comm_.any(renewed)) evaluate(tissue, false);  // the packing of sisters counts at their neighbours, too
}

std::vector<SymMat3<double>> Mechanics::stresses_of_shells(const Tissue& tissue) const {
  const std::vector<Vec3d> loads = load_forces(model_, tissue, comm_);
  std::vector<SymMat3<double>> out(scene_.owned_shells());
  const std::span<const Vec3d> x = scene_.position();
  parallel_for(threads_, out.size(), [&](std::size_t i) {
    const ContactBody& body = scene_.bodies()[i];
    const Vec3d center = volume_centroid(scene_.topologies()[i]->faces(), x.subspan(body.first_point, body.point_count));
    SymMat3<double> sum;
    for (std::uint32_t n = body.first_point; n < body.first_point + body.point_count; ++n)
      sum += symmetric(x[n] - center, loads.empty() ? gradient_.force[n] : gradient_.force[n] + loads[n]);
    out[i] = (1.0 / geometry_.volume[i]) * sum;
  });
  return out;
}

std::vector<double> Mechanics::pressures_from(const Tissue& tissue, std::span<const SymMat3<double>> of_shells,
                                              std::span<const SphereTouch> touches) const {
  std::vector<double> out;
  for (const SymMat3<double>& stress : of_shells) out.push_back(-trace(stress) / 3.0);
  std::vector<double> virial(scene_.owned_spheres());
  for (std::size_t i = 0; i < virial.size(); ++i) virial[i] = spheres_.virial(i);
  for (const SphereTouch& touch : touches)
    if (scene_.bodies()[touch.sphere].owned) virial[touch.sphere - scene_.first_sphere()] -= morula::dot(touch.place, touch.force);
  out.resize(of_shells.size() + virial.size());
  parallel_for(threads_, virial.size(), [&](std::size_t i) {
    out[of_shells.size() + i] =
        cbm::sphere_pressure(virial[i], ball(tissue.spheres.radius[i]), model_.types[tissue.spheres.type[i]].shell.bulk_modulus);
  });
  return out;
}

std::vector<double> Mechanics::pressures(const Tissue& tissue) {
  look(tissue);
  return pressures_from(tissue, stresses_of_shells(tissue), contacts_.touches_of_spheres(contact_scene()));
}

BodyValues Mechanics::values(const Tissue& tissue) {
  look(tissue);
  const std::vector<SphereTouch> touches = contacts_.touches_of_spheres(contact_scene());
  BodyValues values;
  values.stress = stresses_of_shells(tissue);
  values.pressure = values.inner_pressure = pressures_from(tissue, values.stress, touches);
  const std::size_t shells = scene_.owned_shells(), spheres = scene_.owned_spheres();
  values.stress.resize(shells + spheres);
  for (auto* v : {&values.volume, &values.area, &values.contact_area}) v->assign(shells + spheres, 0.0);
  for (std::size_t i = 0; i < shells; ++i) {
    values.volume[i] = geometry_.volume[i];
    values.area[i] = geometry_.area[i];
    values.inner_pressure[i] = shells_.forces().pressure[i];
    values.contact_area[i] = gradient_.contact_area[i];
  }
  std::vector<SphereContacts::Pressing> pressing = spheres_.pressing(scene_, contacts_);
  for (const SphereTouch& touch : touches) {
    if (!scene_.bodies()[touch.sphere].owned) continue;
    SphereContacts::Pressing& sum = pressing[touch.sphere - scene_.first_sphere()];
    sum.area += touch.area;
    sum.virial += symmetric(touch.place, touch.force * -1.0);
  }
  for (std::size_t i = 0; i < spheres; ++i) {
    const double r = tissue.spheres.radius[i], modulus = model_.types[tissue.spheres.type[i]].shell.bulk_modulus;
    values.volume[shells + i] = ball(r);
    values.area[shells + i] = 4.0 * std::numbers::pi * r * r;
    values.contact_area[shells + i] = pressing[i].area;
    values.stress[shells + i] = (-1.0 / cbm::pressed_volume(values.pressure[shells + i], ball(r), modulus)) * pressing[i].virial;
  }
  return values;
}

std::vector<double> Mechanics::packing() const {
  std::vector<double> out(scene_.owned_spheres());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = spheres_.packing(i);
  return out;
}

std::vector<Vec3d> Mechanics::obstacle_forces(const Tissue& tissue) {
  std::vector<Vec3d> out(model_.obstacles.size());
  if (out.empty()) return out;
  prepare(tissue);
  std::vector<OrderFreeSum> sums(3 * out.size());
  const auto add = [&](std::uint32_t obstacle, const Vec3d& force) {
    if (obstacle >= out.size()) return;  // walls of the domain come after the obstacles
    for (std::size_t axis = 0; axis < 3; ++axis) sums[3 * obstacle + axis].add(force[axis]);
  };
  for (const SurfacePair& pair : contacts_.pairs())
    if (pair.rigid && scene_.bodies()[pair.a].owned) add(pair.b, pair.push);
  spheres_.for_pushed_obstacles(add);
  std::vector<double> totals(sums.size());
  comm_.sum(sums, totals);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {totals[3 * i], totals[3 * i + 1], totals[3 * i + 2]};
  return out;
}

}  // namespace morula
