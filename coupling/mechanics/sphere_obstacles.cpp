/// Obstacles that bear spheres: where they meet, and with which force (decisions 0023, 0075, 0087).
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cbm/contact_on.h"
#include "core/ball.h"
#include "core/mesh/pseudonormal.h"
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

constexpr double kOnSurface = 1e-3;  // a point nearer to a surface lies on it [µm]

/// Whether the foot of p on an obstacle, `distance` from p, is no place of what there is to touch, because it lies as deep as `depth` in another obstacle: within that,
/// or on it where that comes nearer to p, or as near and `comes_first` (floors that meet flush). p in the frame of the other.
bool covers(const RigidSurface& other, double depth, const Vec3d& p, double distance, bool comes_first) {
  constexpr double kTie = 1e-9;  // of distances
  if (depth < -kOnSurface) return false;
  const auto near = other.tree->nearest(p, distance * (1.0 + kTie));
  if (!near) return false;
  return depth > kOnSurface || comes_first || std::sqrt(near->closest.distance2) < distance * (1.0 - kTie);
}

}  // namespace

bool SphereContacts::find_covered(const Scene& scene, RigidPair& pair, const Foot& foot) const {
  if (!(foot.distance > 0.0) || layer().obstacles().size() < 2) return false;
  const Vec3d place = foot.point + layer().obstacle_offset(pair.obstacle);
  if (norm(place - pair.clear_at) < pair.clear) return false;
  const Vec3d center = scene.position()[scene.bodies()[scene.first_sphere() + pair.sphere].first_point] - pair.image.shift;
  bool covered = false;
  double clear = std::numeric_limits<double>::infinity();
  for (std::uint32_t o = 0; o < layer().obstacles().size(); ++o) {
    if (o == pair.obstacle) continue;
    const RigidSurface& other = layer().obstacles()[o];
    const Vec3d offset = layer().obstacle_offset(o), there = place - offset;
    const auto near = other.tree->nearest(there);
    const double out = signed_distance(*other.topology, other.position, there, near->face, near->closest);
    clear = std::min(clear, out - kOnSurface);
    covered = covered || covers(other, -out, center - offset, foot.distance, o < pair.obstacle);
  }
  pair.clear_at = place;
  pair.clear = std::ranges::any_of(model_.obstacles, &ObstacleSpec::moves) ? 0.0 : clear;
  return covered;
}

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
  if (!foot || find_covered(scene, pair, *foot)) {
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
  const cbm::ContactOn on = cbm::contact_on(body.radius, pair.support->curvature);
  const auto [response, attached_next] = contact.law->respond(contact, on.radius, overlap, pair.attached);
  pair.force = response.force;
  pair.energy = response.energy;
  pair.area = on.area * response.area;
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
  element.isotropic = static_cast<float>(pair.area * entry.tangential_friction);
  element.axial = static_cast<float>(pair.area * (entry.normal_friction - entry.tangential_friction));
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
