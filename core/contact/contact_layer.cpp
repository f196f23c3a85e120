#include "core/contact/contact_layer.h"

#include <algorithm>
#include <cmath>

namespace morula {

ContactLayer::ContactLayer(ContactSettings settings, std::vector<RigidSurface> obstacles, std::vector<ContactMaterial> materials,
                           std::size_t material_count)
    : settings_(settings),
      obstacles_(std::move(obstacles)),
      offsets_(obstacles_.size()),
      last_offsets_(obstacles_.size()),
      materials_(std::move(materials)),
      material_count_(material_count) {}

void ContactLayer::set_depth(double depth) {
  if (depth == settings_.depth) return;
  settings_.depth = depth;
  for (SurfacePair& pair : pairs_) pair.built_at = -1e300;
}

void ContactLayer::set_offsets(std::span<const Vec3d> offsets) { offsets_.assign(offsets.begin(), offsets.end()); }

void ContactLayer::set_cap(double cap) {
  for (ContactMaterial& material : materials_) material.law.cap = cap;
}

PairBody ContactLayer::view(const ContactScene& scene, const SurfacePair& pair, int which) const {
  if (which == 1 && pair.rigid) {
    const RigidSurface& obstacle = obstacles_[pair.b];
    return {obstacle.topology.get(),
            obstacle.position,
            obstacle.geometry.face_normal,
            obstacle.geometry.face_area,
            obstacle.geometry.node_normal,
            offsets_[pair.b],
            0.0};
  }
  const ContactBody& body = scene.bodies[which == 0 ? pair.a : pair.b];
  const Vec3d shift = which == 0 ? Vec3d{} : pair.shift;
  const auto points = scene.position.subspan(body.first_point, body.point_count);
  if (body.shape == BodyShape::kSphere) return {nullptr, points, {}, {}, {}, shift, body.radius};
  const SurfaceGeometry& geometry = *scene.geometry;
  const std::size_t faces = body.topology->face_count();
  return {body.topology,
          points,
          std::span(geometry.face_normal).subspan(body.first_face, faces),
          std::span(geometry.face_area).subspan(body.first_face, faces),
          std::span(geometry.node_normal).subspan(body.first_point, body.point_count),
          shift,
          0.0};
}

bool ContactLayer::note_motion(const ContactScene& scene) {
  if (fresh_ || last_position_.size() != scene.position.size() || motion_.size() != scene.bodies.size()) return true;
  bool outdated = false;
  const double limit = 0.5 * settings_.body_skin;
#pragma omp parallel for schedule(static) num_threads(settings_.threads) reduction(|| : outdated)
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const ContactBody& body = scene.bodies[i];
    BodyMotion motion;
    for (std::uint32_t p = body.first_point; p < body.first_point + body.point_count; ++p)
      motion.mean += scene.position[p] - last_position_[p];
    motion.mean *= 1.0 / body.point_count;
    double deviation2 = 0.0;
    for (std::uint32_t p = body.first_point; p < body.first_point + body.point_count; ++p) {
      deviation2 = std::max(deviation2, norm2(scene.position[p] - last_position_[p] - motion.mean));
      last_position_[p] = scene.position[p];
    }
    motion.deviation = std::sqrt(deviation2) + std::abs(body.radius - last_radius_[i]);
    last_radius_[i] = body.radius;
    motion_[i] = motion;
    travel_[i] += (norm(motion.mean) + motion.deviation) * 1.000001;
    if (travel_[i] > limit) outdated = true;
  }
  double fastest_obstacle = 0.0;
  for (std::size_t i = 0; i < offsets_.size(); ++i) fastest_obstacle = std::max(fastest_obstacle, norm(offsets_[i] - last_offsets_[i]));
  obstacle_travel_ += fastest_obstacle;
  for (SurfacePair& pair : pairs_) {
    const BodyMotion& a = motion_[pair.a];
    const BodyMotion b = pair.rigid ? BodyMotion{offsets_[pair.b] - last_offsets_[pair.b], 0.0} : motion_[pair.b];
    pair.motion += (norm(a.mean - b.mean) + a.deviation + b.deviation) * 1.000001;
  }
  last_offsets_ = offsets_;
  return outdated || obstacle_travel_ > limit;
}

void ContactLayer::add_obstacle_pairs(const ContactScene& scene) {
  if (obstacles_.empty()) return;
  const double distance = reach().candidates() + settings_.body_skin;
  std::vector<std::uint32_t> by_place(scene.bodies.size());
  for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) by_place[scene.bodies[i].place] = i;
  for (const std::uint32_t i : by_place) {
    const ContactBody& body = scene.bodies[i];
    if (body.shape == BodyShape::kSphere || !body.owned) continue;
    Box box;
    for (std::uint32_t p = 0; p < body.point_count; ++p) box.include(scene.position[body.first_point + p]);
    for (std::uint32_t o = 0; o < obstacles_.size(); ++o) {
      Box there = box.inflated(distance);
      there = {there.low - offsets_[o], there.high - offsets_[o]};
      if (obstacles_[o].tree->faces_in(there).empty()) continue;
      SurfacePair pair;
      pair.a = i;
      pair.b = o;
      pair.rigid = true;
      pairs_.push_back(std::move(pair));
    }
  }
}

void ContactLayer::rebuild(const ContactScene& scene, const Space& space) {
  const std::size_t n = scene.bodies.size();
  std::vector<Extent> extents(n);
  std::vector<std::uint32_t> place(n);
  std::vector<char> owned(n);
#pragma omp parallel for schedule(static) num_threads(settings_.threads)
  for (std::size_t i = 0; i < n; ++i) {
    const ContactBody& body = scene.bodies[i];
    place[i] = body.place;
    owned[i] = body.owned;
    Extent& extent = extents[i];
    for (std::uint32_t p = 0; p < body.point_count; ++p) extent.box.include(scene.position[body.first_point + p]);
    const bool sphere = body.shape == BodyShape::kSphere;
    const double reach = 0.5 * (settings_.body_skin + (sphere ? std::max(settings_.range, settings_.sphere_reach) : settings_.range));
    extent.box = extent.box.inflated(reach + body.radius);
    extent.center = extent.box.center();
    double radius2 = 0.0;
    for (std::uint32_t p = 0; p < body.point_count; ++p)
      radius2 = std::max(radius2, norm2(scene.position[body.first_point + p] - extent.center));
    extent.radius = std::sqrt(radius2) + reach + body.radius;
  }
  spheres_.clear();
  std::vector<SurfacePair> old = std::move(pairs_);
  pairs_.clear();
  for (const BodyPair& found : find_body_pairs(extents, place, owned, space)) {
    const bool spheres = scene.bodies[found.a].shape == BodyShape::kSphere && scene.bodies[found.b].shape == BodyShape::kSphere;
    if (spheres) {
      spheres_.push_back({found.a, found.b, found.shift});
    } else {
      SurfacePair& pair = pairs_.emplace_back();
      pair.a = found.a;
      pair.b = found.b;
      pair.shift = found.shift;
    }
  }
  add_obstacle_pairs(scene);

  if (!fresh_) {  // keep the lists of pairs that stay; both sequences come in canonical order, obstacles last
    const auto key = [&](const SurfacePair& pair) {
      return std::array<std::uint64_t, 3>{pair.rigid, scene.bodies[pair.a].place, pair.rigid ? pair.b : scene.bodies[pair.b].place};
    };
    std::size_t k = 0;
    for (SurfacePair& pair : pairs_) {
      while (k < old.size() && key(old[k]) < key(pair)) ++k;
      if (k < old.size() && key(old[k]) == key(pair) && old[k].shift == pair.shift) pair = std::move(old[k]);
    }
  }
  incident_begin_.assign(n + 1, 0);
  for (const SurfacePair& pair : pairs_) {
    ++incident_begin_[pair.a + 1];
    if (!pair.rigid) ++incident_begin_[pair.b + 1];
  }
  for (std::size_t i = 1; i <= n; ++i) incident_begin_[i] += incident_begin_[i - 1];
  incident_.resize(incident_begin_[n]);
  std::vector<std::uint32_t> next(incident_begin_.begin(), incident_begin_.end() - 1);
  for (std::uint32_t k = 0; k < pairs_.size(); ++k) {
    incident_[next[pairs_[k].a]++] = {k, 0};
    if (!pairs_[k].rigid) incident_[next[pairs_[k].b]++] = {k, 1};
  }
  last_position_.assign(scene.position.begin(), scene.position.end());
  last_offsets_ = offsets_;
  motion_.assign(n, {});
  last_radius_.resize(n);
  for (std::size_t i = 0; i < n; ++i) last_radius_[i] = scene.bodies[i].radius;
  travel_.assign(n, 0.0);
  obstacle_travel_ = 0.0;
  fresh_ = false;
}

void ContactLayer::rebuild_lists(const ContactScene& scene, SurfacePair& pair) {
  const PairBody body[2] = {view(scene, pair, 0), view(scene, pair, 1)};
  std::vector<std::uint32_t> faces[2];
  for (int which = 0; which < 2; ++which) {
    if (body[which].topology == nullptr) continue;
    Box other;
    const PairBody& o = body[1 - which];
    if (pair.rigid && which == 0) continue;  // nothing is held against the cell's faces
    for (std::uint32_t i = 0; i < o.position.size(); ++i) other.include(o.node(i));
    other = other.inflated(o.radius + reach().candidates());
    if (pair.rigid) {
      const Box there{other.low - body[1].shift, other.high - body[1].shift};
      faces[1] = obstacles_[pair.b].tree->faces_in(there);
      continue;
    }
    for (std::uint32_t face = 0; face < body[which].topology->face_count(); ++face) {
      Box box;
      for (const std::uint32_t node : body[which].topology->faces()[face]) box.include(body[which].node(node));
      if (box.overlaps(other)) faces[which].push_back(face);
    }
  }
  for (int d = 0; d < 2; ++d) {
    if (body[d].topology == nullptr || (pair.rigid && d == 1)) {
      pair.points[d] = {};
      continue;
    }
    build_point_lists(body[d], body[1 - d], reach(), settings_.points_per_face, faces[1 - d], pair.points[d]);
  }
  number_pair_nodes(body[0].topology, body[1].topology, pair);
  pair.built_at = pair.motion;
}

void ContactLayer::evaluate_pair(const ContactScene& scene, SurfacePair& pair) {
  if (pair.motion - pair.built_at > settings_.skin) rebuild_lists(scene, pair);
  clear_results(pair);
  if (!scene.bodies[pair.a].moves && (pair.rigid || !scene.bodies[pair.b].moves)) return;  // both held: nothing to find
  const PairBody body[2] = {view(scene, pair, 0), view(scene, pair, 1)};
  const bool both = !pair.rigid && body[0].topology != nullptr && body[1].topology != nullptr;
  const std::uint16_t material_a = scene.bodies[pair.a].material;
  const std::uint16_t material_b = pair.rigid ? obstacles_[pair.b].material : scene.bodies[pair.b].material;
  ContactMaterial contact = material(material_a, material_b);
  if (!both && !pair.rigid) {  // a sphere gives way by its own foundation (fields_and_coupling.md, D)
    const bool first = body[0].topology == nullptr;
    const double modulus = (first ? contact : material(material_b, material_a)).sphere_modulus;
    contact.law.repulsion = sphere_foundation(modulus, contact.law.adhesion, body[first ? 0 : 1].radius);
    contact.law.cap = 0.0;
  }
  contact.law.adhesion *= hold_;
  contact.normal_friction *= hold_;
  contact.tangential_friction *= hold_;
  for (int d = 0; d < 2; ++d) {
    if (pair.points[d].source_face.empty()) continue;
    evaluate_points({body[d],
                     body[1 - d],
                     contact,
                     FaceQuadrature::with_points(settings_.points_per_face),
                     reach(),
                     both ? 0.5 : 1.0,
                     pair.motion,
                     pair.motion - pair.built_at,
                     !pair.rigid,
                     {}},
                    d, pair);
  }
}

void ContactLayer::evaluate(const ContactScene& scene, bool only_spheres) {
  const auto has_sphere = [&](const SurfacePair& pair) {
    return !pair.rigid && (scene.bodies[pair.a].shape == BodyShape::kSphere || scene.bodies[pair.b].shape == BodyShape::kSphere);
  };
#pragma omp parallel for schedule(dynamic, 4) num_threads(settings_.threads)
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    if (!only_spheres || has_sphere(pairs_[k])) evaluate_pair(scene, pairs_[k]);
}

void ContactLayer::add_energy(const ContactScene& scene, OrderFreeSum& sum) const {
  for (const SurfacePair& pair : pairs_)
    if (scene.bodies[pair.a].owned) sum.add(pair.energy);
}

void ContactLayer::collect(const ContactScene& scene, ContactGradient& gradient) const {
#pragma omp parallel for schedule(static) num_threads(settings_.threads)
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const ContactBody& body = scene.bodies[i];
    if (!body.owned) continue;
    gradient.contact_area[i] = 0.0;
    for (std::uint32_t k = incident_begin_[i]; k < incident_begin_[i + 1]; ++k) {
      const SurfacePair& pair = pairs_[incident_[k].pair];
      const PairGradient& part = pair.gradient[incident_[k].side];
      for (std::size_t m = 0; m < part.node.size(); ++m) gradient.force[body.first_point + part.node[m]] += part.force[m];
      for (std::size_t m = 0; m < part.node_normal.size(); ++m)
        gradient.node_normal[body.first_point + part.node[m]] += part.node_normal[m];
      const auto& faces = pair.points[incident_[k].side].source_face;
      for (std::size_t m = 0; m < part.face_energy.size(); ++m) {
        gradient.face_energy[body.first_face + faces[m]] += part.face_energy[m];
        gradient.contact_area[i] += part.face_contact[m];
      }
      for (std::size_t m = 0; m < part.face_normal.size(); ++m) gradient.face_normal[body.first_face + faces[m]] += part.face_normal[m];
    }
  }
}

const SurfacePair* ContactLayer::deepest(const ContactScene& scene) const {
  const SurfacePair* worst = nullptr;
  for (const SurfacePair& pair : pairs_) {
    const bool surfaces =
        pair.rigid || (scene.bodies[pair.a].shape == BodyShape::kSurface && scene.bodies[pair.b].shape == BodyShape::kSurface);
    if (surfaces && (worst == nullptr || pair.overlap > worst->overlap)) worst = &pair;
  }
  return worst;
}

std::size_t ContactLayer::memory() const {
  const auto bytes = [](const auto& vector) { return vector.capacity() * sizeof(vector[0]); };
  std::size_t total =
      bytes(pairs_) + bytes(spheres_) + bytes(incident_begin_) + bytes(incident_) + bytes(last_position_) + bytes(motion_) + bytes(travel_);
  for (const SurfacePair& pair : pairs_)
    for (int d = 0; d < 2; ++d) {
      const PointsAgainstBody& p = pair.points[d];
      total += bytes(p.source_face) + bytes(p.source_node) + bytes(p.target_face) + bytes(p.target_node) + bytes(p.target_radius) +
               bytes(p.first_candidate) + bytes(p.candidate) + bytes(p.nearest) + bytes(p.good_until);
      const PairGradient& g = pair.gradient[d];
      total += bytes(g.node) + bytes(g.force) + bytes(g.node_normal) + bytes(g.face_energy) + bytes(g.face_normal) + bytes(g.face_contact);
      total += bytes(pair.elements[d]) + bytes(pair.step_elements[d]);
    }
  return total;
}

}  // namespace morula
