/// Obstacles that bear spheres: where they meet, and with which force (decisions 0023, 0075, 0087).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cbm/radius_on.h"
#include "core/ball.h"
#include "coupling/mechanics/own_contacts.h"
#include "coupling/mechanics/sphere_contacts.h"

namespace morula {
namespace {

constexpr double kFlat = 1e-12;  // [1/µm], [1/µm²]

/// Whether some smooth part of a surface is not flat.
bool is_curved(const RigidSurface& surface) {
  return std::ranges::any_of(surface.curvature, [](const std::array<SurfaceCurvature, 3>& face) {
    return std::ranges::any_of(face, [](const SurfaceCurvature& c) { return std::abs(c.mean) > kFlat || std::abs(c.gaussian) > kFlat; });
  });
}

}  // namespace

void SphereContacts::note_curved_obstacles() {
  for (const RigidSurface& obstacle : layer().obstacles()) is_curved_.push_back(is_curved(obstacle));
}

bool SphereContacts::locate_rigid(const Scene& scene, RigidPair& pair) const {
  const ContactBody& body = scene.bodies()[scene.first_sphere() + pair.sphere];
  const auto& obstacle = layer().obstacles()[pair.obstacle];
  const Vec3d center = scene.position()[body.first_point], from = center - (layer().obstacle_offset(pair.obstacle) + pair.image.shift);
  const auto meet_plane = [&] {
    const TouchingPlane& plane = *pair.support->plane;
    pair.normal = -plane.normal;
    pair.distance = plane.distance + dot(plane.normal, from - plane.from);
    return true;
  };
  if (pair.support && pair.support->plane && (friction_is_frozen_ || pair.support->plane->from == from)) return meet_plane();
  const double reach = body.radius + layer().settings().sphere_reach + layer().settings().body_skin;
  const auto foot = foot_on_part(obstacle, pair.part, from, reach);
  if (!foot) {
    if (!friction_is_frozen_) pair.support.reset();
    return false;
  }
  // Kept over the step, as its friction is: the force is the gradient of the energy then.
  if (!friction_is_frozen_ || !pair.support) {
    pair.support = Support{foot->curvature, {}};
    if (foot->curvature.mean < -kFlat) pair.support->plane = {from, foot->normal, foot->distance - foot->bulge};
  }
  if (pair.support->plane) return meet_plane();
  const Vec3d between = foot->point - from;
  const double distance = norm(between), side = foot->distance < 0.0 ? -1.0 : 1.0;
  pair.normal = distance > cbm::kCoincident ? between * (side / distance) : -obstacle.geometry.face_normal[foot->face];
  pair.distance = side * distance;
  return true;
}

std::size_t SphereContacts::material_of(const RigidPair& pair) const {
  return std::min<std::size_t>(model_.types.size() + pair.obstacle, table_.material_count() - 1);
}

cbm::PairContact SphereContacts::contact_with_obstacle(const Scene& scene, const RigidPair& pair) const {
  const std::size_t number = scene.first_sphere() + pair.sphere;
  const ContactBody& body = scene.bodies()[number];
  OwnContacts own(model_, table_, layer().own_factors());
  return own.vary() ? own.with_obstacle(body, number, material_of(pair)) : table_.entry(body.material, material_of(pair)).contact;
}

void SphereContacts::evaluate_rigid(const Scene& scene, std::size_t k) {
  RigidPair& pair = rigid_[k];
  RigidPairElement& element = list_.rigid[k];
  const ContactBody& body = scene.bodies()[scene.first_sphere() + pair.sphere];
  const bool rubs = friction_is_frozen_ && (element.isotropic != 0.0f || element.axial != 0.0f);
  element.stiffness = 0.0f;
  if (!rubs) element.isotropic = element.axial = 0.0f;
  pair.force = pair.energy = pair.area = pair.distance = 0.0;
  pair.attached_next = false;
  if (!locate_rigid(scene, pair)) return;
  const double overlap = body.radius - pair.distance;
  const auto& entry = table_.entry(body.material, material_of(pair));
  const cbm::PairContact contact = contact_with_obstacle(scene, pair);
  const auto [response, attached_next] =
      contact.law->respond(contact, cbm::radius_on(body.radius, pair.support->curvature), overlap, pair.attached);
  pair.force = response.force;
  pair.energy = response.energy;
  pair.area = response.area;
  pair.attached_next = attached_next;
  element.stiffness = static_cast<float>(response.stiffness);
  if (packing_.acts && overlap > 0.0) {  // the wall takes a cap of the sphere; its energy is the sphere's
    const cbm::PlaneCap cap = cbm::plane_cap(body.radius, overlap);
    const SpherePressure& pressed = packing_.on_surfaces[scene.first_sphere() + pair.sphere];
    const double bending = 2.0 * std::numbers::pi * std::max(0.0, pair.distance);
    pair.force += pressed.pressure * cap.slope;
    element.stiffness += static_cast<float>(cap.slope * pressed.resistance + bending * pressed.pressure);
  }
  if (rubs) return;
  element.n[0] = static_cast<float>(pair.normal.x);
  element.n[1] = static_cast<float>(pair.normal.y);
  element.n[2] = static_cast<float>(pair.normal.z);
  if (friction_is_frozen_) return;
  element.isotropic = static_cast<float>(response.area * entry.tangential_friction);
  element.axial = static_cast<float>(response.area * (entry.normal_friction - entry.tangential_friction));
}

SphereContacts::Renewed SphereContacts::renew_supports(const World& world) {
  std::vector<char> marked;
  bool moved = false;  // some are as far from their obstacle as they were not before, and packed otherwise
  for (RigidPair& pair : rigid_) {
    if (!is_curved_[pair.obstacle] || !pair.support) continue;
    const Support before = *pair.support;
    if (locate_rigid(world.scene, pair) && *pair.support == before) continue;
    mark(marked, world.scene, pair.sphere);
    moved = moved || before.plane || !pair.support || pair.support->plane;
  }
  if (marked.empty()) return Renewed::kNothing;
  refresh_values(world.scene, marked);
  return moved ? Renewed::kPacking : Renewed::kValues;
}

}  // namespace morula
