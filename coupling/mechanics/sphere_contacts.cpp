#include "coupling/mechanics/sphere_contacts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cbm/division_ramp.h"
#include "cbm/laws/jkr.h"
#include "cbm/pair_forces.h"
#include "core/mesh/pseudonormal.h"

namespace morula {

SphereContacts::SphereContacts(const Model& model) : model_(model) {
  const std::size_t types = model.types.size(), materials = model.material_count() + 1;  // the last one: walls
  materials_.resize(types * materials);
  for (std::size_t a = 0; a < types; ++a) {
    const auto& s = model.types[a].sphere;
    for (std::size_t b = 0; b < materials; ++b) {
      const bool adhesive = s.adhesive && b < model.material_count() && (b >= types || model.types[b].sphere.adhesive);
      const double adhesion = adhesive ? model.pair(a, b).adhesion : 0.0;
      materials_[a * materials + b] = b < types ? cbm::ContactMaterial::elastic(s.young, s.poisson, model.types[b].sphere.young,
                                                                                model.types[b].sphere.poisson, adhesion)
                                                : cbm::ContactMaterial::against_rigid(s.young, s.poisson, adhesion);
    }
  }
}

void SphereContacts::set_pairs(const Scene& scene, const ContactLayer& contacts, const Tissue& tissue) {
  pairs_.clear();
  sisters_.clear();
  const auto bodies = scene.bodies();
  const std::size_t first = scene.first_sphere();
  const auto is_attached = [&](std::uint32_t owned, CellId partner) {
    const auto& list = tissue.spheres.attached[owned - first];
    return std::binary_search(list.begin(), list.end(), partner);
  };
  for (const SphereNeighbours& n : contacts.sphere_neighbours()) {
    Pair pair{n.a, n.b, n.shift, {}, 0.0, false, false};
    pair.attached = bodies[n.a].owned ? is_attached(n.a, bodies[n.b].id) : is_attached(n.b, bodies[n.a].id);
    if (cbm::are_sisters(bodies[n.a].id, bodies[n.b].id)) sisters_.push_back(static_cast<std::uint32_t>(pairs_.size()));
    pairs_.push_back(pair);
  }
  const auto obstacles = contacts.obstacles();
  for (std::uint32_t i = static_cast<std::uint32_t>(first); i < first + scene.owned_spheres(); ++i)
    for (std::uint32_t o = 0; o < obstacles.size(); ++o) {
      const double reach = bodies[i].radius + contacts.settings().sphere_reach + contacts.settings().body_skin;
      Box box;
      box.include(scene.position()[bodies[i].first_point] - contacts.obstacle_offset(o));
      if (obstacles[o].tree->faces_in(box.inflated(reach)).empty()) continue;
      Pair pair{i, o, {}, {}, 0.0, false, true};
      // An obstacle is a partner too: its number stands where a cell's id would, with no founder path.
      pair.attached = is_attached(i, CellId(o + 1));
      pairs_.push_back(pair);
    }
  update_laws(scene, tissue);

  incident_begin_.assign(bodies.size() - first + 1, 0);
  for (const Pair& pair : pairs_) {
    ++incident_begin_[pair.a - first + 1];
    if (!pair.rigid) ++incident_begin_[pair.b - first + 1];
  }
  for (std::size_t i = 1; i < incident_begin_.size(); ++i) incident_begin_[i] += incident_begin_[i - 1];
  incident_.resize(incident_begin_.back());
  std::vector<std::uint32_t> next(incident_begin_.begin(), incident_begin_.end() - 1);
  for (std::uint32_t k = 0; k < pairs_.size(); ++k) {
    incident_[next[pairs_[k].a - first]++] = 2 * k;
    if (!pairs_[k].rigid) incident_[next[pairs_[k].b - first]++] = 2 * k + 1;
  }
}

void SphereContacts::update_law(const Scene& scene, double now, Pair& pair) const {
  const auto bodies = scene.bodies();
  const std::size_t materials = model_.material_count() + 1;
  const ContactBody& a = bodies[pair.a];
  pair.overlap_offset = 0.0;
  if (pair.rigid) {
    const std::size_t material = std::min<std::size_t>(model_.types.size() + pair.b, materials - 1);
    pair.law = cbm::make_pair_law(materials_[a.material * materials + material], a.radius);
    return;
  }
  const ContactBody& b = bodies[pair.b];
  pair.law = cbm::make_pair_law(materials_[a.material * materials + b.material], a.radius, b.radius);
  if (!cbm::are_sisters(a.id, b.id)) return;
  pair.overlap_offset = cbm::sister_overlap_offset(pair.law, a.radius, b.radius, scene.birth_radius(pair.a), scene.birth_radius(pair.b),
                                                   now - scene.birth_time(pair.a));
}

void SphereContacts::update_laws(const Scene& scene, const Tissue& tissue) {
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < pairs_.size(); ++k) update_law(scene, tissue.clock.time, pairs_[k]);
}

bool SphereContacts::renew_sisters(const Scene& scene, const ContactLayer& contacts, const Tissue& tissue) {
  for (const std::uint32_t k : sisters_) {
    update_law(scene, tissue.clock.time, pairs_[k]);
    evaluate_pair(scene, contacts, k);
  }
  return !sisters_.empty();
}

void SphereContacts::make_element(const Pair& pair, const ContactBody& a, const ContactBody* b, const Response& response, double area,
                                  double stiffness, SpherePairElement& element) const {
  double normal_friction = 0.0, tangential_friction = 0.0;
  const std::size_t other = b != nullptr ? b->material : model_.types.size() + pair.b;
  if (other < model_.material_count()) {
    normal_friction = model_.pair(a.material, other).normal_friction;
    tangential_friction = model_.pair(a.material, other).tangential_friction;
  }
  element = {a.first_point,
             b != nullptr ? b->first_point : kRigidPoint,
             pair.a,
             b != nullptr ? pair.b : pair.a,
             {static_cast<float>(response.normal.x), static_cast<float>(response.normal.y), static_cast<float>(response.normal.z)},
             static_cast<float>(area * tangential_friction),
             static_cast<float>(area * (normal_friction - tangential_friction)),
             static_cast<float>(stiffness)};
}

void SphereContacts::evaluate_pair(const Scene& scene, const ContactLayer& contacts, std::size_t k) {
  const auto bodies = scene.bodies();
  const auto& x = scene.position();
  const Pair& pair = pairs_[k];
  const ContactBody& a = bodies[pair.a];
  Response& response = responses_[k];
  response = {};
  const ContactBody* b = pair.rigid ? nullptr : &bodies[pair.b];
  if (b != nullptr) {
    const Vec3d between = x[b->first_point] + pair.shift - x[a.first_point];
    response.distance = norm(between);
    response.normal = response.distance > 1e-9 ? between * (1.0 / response.distance) : Vec3d{0, 0, 1};
    response.overlap = a.radius + b->radius - response.distance - pair.overlap_offset;
  } else {
    const auto& obstacle = contacts.obstacles()[pair.b];
    const double reach = a.radius + contacts.settings().sphere_reach + contacts.settings().body_skin;
    const auto near = obstacle.tree->nearest(x[a.first_point] - contacts.obstacle_offset(pair.b), reach);
    if (!near) {
      elements_[k] = {a.first_point, kRigidPoint, pair.a, pair.a, {0, 0, 1}, 0, 0, 0};
      response.overlap = -1e300;
      return;
    }
    const Vec3d from = x[a.first_point] - contacts.obstacle_offset(pair.b);
    const double side = signed_distance(*obstacle.topology, obstacle.position, from, near->face, near->closest) < 0.0 ? -1.0 : 1.0;
    const Vec3d between = near->closest.point + contacts.obstacle_offset(pair.b) - x[a.first_point];
    const double distance = norm(between);
    response.distance = side * distance;
    response.normal = distance > 1e-9 ? between * (side / distance) : -obstacle.geometry.face_normal[near->face];
    response.overlap = a.radius - response.distance;
  }
  if (response.overlap < (pair.attached ? cbm::kBreakOverlap * pair.law.length : 0.0)) {  // out of reach: most of what the skin adds
    elements_[k] = {a.first_point, b != nullptr ? b->first_point : kRigidPoint, pair.a, b != nullptr ? pair.b : pair.a, {0, 0, 1}, 0, 0, 0};
    return;
  }
  const auto law = cbm::contact_response(pair.law, response.overlap, pair.attached);
  response.force = law.force;
  response.energy = law.energy;
  response.area = law.area;
  make_element(pair, a, b, response, law.area, law.stiffness, elements_[k]);
}

void SphereContacts::evaluate(const Scene& scene, const ContactLayer& contacts) {
  responses_.resize(pairs_.size());
  elements_.resize(pairs_.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < pairs_.size(); ++k) evaluate_pair(scene, contacts, k);
}

void SphereContacts::add_energy(const Scene& scene, OrderFreeSum& sum) const {
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    if (responses_[k].energy != 0.0 && scene.bodies()[pairs_[k].a].owned) sum.add(responses_[k].energy);
}

void SphereContacts::collect(const Scene& scene, std::span<Vec3d> force) const {
  const std::size_t first = scene.first_sphere();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < scene.owned_spheres(); ++i) {
    Vec3d sum;
    for (std::uint32_t k = incident_begin_[i]; k < incident_begin_[i + 1]; ++k) {
      const Response& response = responses_[incident_[k] / 2];
      sum += response.normal * (incident_[k] % 2 == 0 ? -response.force : response.force);
    }
    force[scene.bodies()[first + i].first_point] += sum;
  }
}

void SphereContacts::add_step_friction(const Scene& scene, std::span<const Vec3d> displacement, std::span<Vec3d> out,
                                       OrderFreeSum& quadratic) const {
  for (std::size_t i = 0; i < scene.owned_spheres(); ++i) {
    const std::uint32_t point = scene.sphere_point() + static_cast<std::uint32_t>(i);
    const double gamma = medium_friction_[point];
    out[point] += displacement[point] * gamma;
    quadratic.add(gamma * norm2(displacement[point]));
  }
  for (const SpherePairElement& e : step_elements_) {
    if (e.a == 0.0f && e.b == 0.0f) continue;
    const bool rigid = e.j == kRigidPoint;
    const Vec3d u = rigid ? displacement[e.i] : displacement[e.i] - displacement[e.j];
    const Vec3d n{e.n[0], e.n[1], e.n[2]};
    const Vec3d f = u * static_cast<double>(e.a) + n * (static_cast<double>(e.b) * dot(n, u));
    if (scene.bodies()[e.body_i].owned) {
      out[e.i] += f;
      quadratic.add(dot(f, u));
    }
    if (!rigid && scene.bodies()[e.body_j].owned) out[e.j] -= f;
  }
}

bool SphereContacts::update_attached(const Scene& scene, Tissue& tissue) {
  const auto bodies = scene.bodies();
  bool changed = false;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    Pair& pair = pairs_[k];
    const bool attached = cbm::update_attached(responses_[k].overlap, pair.attached, pair.law);
    if (attached == pair.attached) continue;
    pair.attached = attached;
    const auto law = cbm::contact_response(pair.law, responses_[k].overlap, attached);
    responses_[k].force = law.force;
    responses_[k].energy = law.energy;
    responses_[k].area = law.area;
    changed = true;
  }
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < scene.owned_spheres(); ++i) {
    auto& list = tissue.spheres.attached[i];
    std::size_t known = 0, attached = 0;
    const auto partner = [&](std::uint32_t incidence) {
      const Pair& pair = pairs_[incidence / 2];
      return pair.rigid ? CellId(pair.b + 1) : bodies[incidence % 2 == 0 ? pair.b : pair.a].id;
    };
    for (std::uint32_t k = incident_begin_[i]; k < incident_begin_[i + 1]; ++k) {
      if (!pairs_[incident_[k] / 2].attached) continue;
      ++attached;
      if (std::binary_search(list.begin(), list.end(), partner(incident_[k]))) ++known;
    }
    if (known == attached && attached == list.size()) continue;
    list.clear();
    for (std::uint32_t k = incident_begin_[i]; k < incident_begin_[i + 1]; ++k)
      if (pairs_[incident_[k] / 2].attached) list.push_back(partner(incident_[k]));
    std::sort(list.begin(), list.end());
  }
  return changed;
}

void SphereContacts::add_values(const Scene& scene, const Tissue& tissue, std::span<double> pressure,
                                std::span<double> contact_area) const {
  for (std::size_t i = 0; i < scene.owned_spheres(); ++i) {
    double virial = 0.0;
    for (std::uint32_t k = incident_begin_[i]; k < incident_begin_[i + 1]; ++k) {
      const Response& response = responses_[incident_[k] / 2];
      virial += response.distance * response.force;
      contact_area[i] += response.area;
    }
    const double r = tissue.spheres.radius[i];
    pressure[i] = cbm::virial_pressure(virial, (4.0 / 3.0) * std::numbers::pi * r * r * r);
  }
}

std::size_t SphereContacts::memory() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return bytes(pairs_) + bytes(responses_) + bytes(elements_) + bytes(step_elements_) + bytes(incident_) + bytes(incident_begin_);
}

}  // namespace morula
