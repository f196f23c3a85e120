#include "core/contact/contact_layer.h"

#include <omp.h>
#include <cassert>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contact/float_rounding.h"
#include "core/contact/sphere_touch.h"
#include "core/parallel/threads.h"

namespace morula {
namespace {

constexpr std::size_t kPairsOfShare = 16;  // evaluated by each of several threads before their gradients are collected

/// Whether both are daughters of one cell: their ids differ in the last step of the lineage alone.
bool are_sisters(CellId a, CellId b) {
  return a.generation() > 0 && a.generation() == b.generation() && (a.bits() ^ b.bits()) == std::uint64_t{1} << CellId::kFounderBits;
}

}  // namespace

ContactLayer::ContactLayer(ContactSettings settings, RigidSurfaces obstacles, std::vector<ContactMaterial> materials,
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

bool ContactLayer::is_at_step_start() const {
  return std::ranges::any_of(pairs_, [](const SurfacePair& pair) { return pair.at_start; });
}

void ContactLayer::set_offsets(std::span<const Vec3d> offsets) { offsets_.assign(offsets.begin(), offsets.end()); }

void ContactLayer::set_cap(double cap) {
  for (ContactMaterial& material : materials_) material.law.cap = cap;
}

PairBody ContactLayer::view(const ContactScene& scene, const SurfacePair& pair, int which) const {
  if (which == 1 && pair.rigid) {
    const RigidSurface& obstacle = obstacles_[pair.b];
    return {obstacle.topology.get(), obstacle.position, obstacle.geometry.node_normal, offsets_[pair.b] + pair.shift, 0.0};
  }
  const std::uint32_t number = which == 0 ? pair.a : pair.b;
  const ContactBody& body = scene.bodies[number];
  const Vec3d shift = which == 0 ? Vec3d{} : pair.shift;
  const auto points = scene.position.subspan(body.first_point, body.point_count);
  if (body.shape == BodyShape::kSphere) return {nullptr, points, {}, shift, body.radius};
  const Topology* topology = scene.topology[number];
  const MarkSets marks = scene.marks.faces(scene.first_face[number], topology->face_count());
  return {topology, points, std::span(scene.geometry->node_normal).subspan(body.first_point, body.point_count), shift, 0.0, marks};
}

const SisterBond* ContactLayer::sister_bond(const ContactScene& scene, const SurfacePair& pair) const {
  if (sister_bonds_.empty() || !are_sisters(scene.bodies[pair.a].id, scene.bodies[pair.b].id)) return nullptr;
  for (const std::uint32_t body : {pair.a, pair.b}) {  // both are listed, alike, or that which is of this rank
    const CellId id = scene.bodies[body].id;
    const auto at = std::ranges::lower_bound(sister_bonds_, id, {}, &SisterBond::cell);
    if (at != sister_bonds_.end() && at->cell == id) return &*at;
  }
  return nullptr;
}

double ContactLayer::own_adhesion(const SurfacePair& pair) const {
  if (own_.adhesion.empty() || pair.with_itself()) return 1.0;
  return std::sqrt(own_.adhesion[pair.a] * (pair.rigid ? 1.0 : own_.adhesion[pair.b]));
}

double ContactLayer::both_tensions(const ContactScene& scene, const SurfacePair& pair, double ContactMaterial::*of) const {
  const auto one = [&](std::uint32_t i, std::uint32_t other) {
    if (scene.bodies[i].shape == BodyShape::kSphere) return 0.0;
    const double of_type = material(scene.bodies[i].material, scene.bodies[other].material).*of;
    return own_.tension.empty() ? of_type : of_type * own_.tension[i];
  };
  return one(pair.a, pair.b) + one(pair.b, pair.a);
}

double ContactLayer::patch_motion(const ContactScene& scene, const SurfacePair& pair) const {
  BodyMotion side[2];
  for (int which = 0; which < 2; ++which) {
    if (which == 1 && pair.rigid) {
      side[1].mean = offsets_[pair.b] - last_offsets_[pair.b];
      continue;
    }
    const std::uint32_t body = which == 0 ? pair.a : pair.b;
    if (scene.bodies[body].shape == BodyShape::kSphere) {
      side[which] = motion_[body];
      continue;
    }
    Box box;
    const std::uint32_t first = scene.bodies[body].first_point;
    for (const std::uint16_t node : pair.node[which]) box.include(scene.position[first + node] - to_double(known_at_[first + node]));
    if (pair.node[which].empty()) continue;
    side[which] = {box.center(), 0.5 * norm(box.high - box.low) + rounding_};
  }
  return (norm(side[0].mean - side[1].mean) + side[0].deviation + side[1].deviation) * 1.000001;
}

ContactLayer::BodyMotion ContactLayer::motion_of(const ContactScene& scene, const ContactBody& body, std::uint32_t known_point,
                                                 float last_radius) const {
  const Vec3d* const now = scene.position.data() + body.first_point;
  const Vec3f* const before = known_at_.data() + known_point;
  BodyMotion motion;
  for (std::uint32_t p = 0; p < body.point_count; ++p) motion.mean += now[p] - to_double(before[p]);
  motion.mean *= 1.0 / body.point_count;
  double deviation2 = 0.0;
  for (std::uint32_t p = 0; p < body.point_count; ++p)
    deviation2 = std::max(deviation2, norm2(now[p] - to_double(before[p]) - motion.mean));
  motion.deviation = std::sqrt(deviation2) + rounding_ + growth(body, last_radius);
  return motion;
}

bool ContactLayer::note_motion(const ContactScene& scene) {
  if (fresh_ || stray_.size() != scene.bodies.size()) return true;
  if (known_at_.size() != scene.position.size()) return true;
  double of_obstacles = 0.0;
  for (std::size_t i = 0; i < offsets_.size(); ++i) of_obstacles = std::max(of_obstacles, norm(offsets_[i] - last_offsets_[i]));
  if (travel_.empty()) {  // they are where they were when the list was made
    obstacle_travel_ = of_obstacles;
  } else {
    obstacle_travel_ += of_obstacles;
    note_motion_of_pairs(scene);
  }
  skin_used_ = std::max(find_strays(scene), obstacle_travel_ * 1.000001 / (0.5 * settings_.body_skin));
  return skin_used_ > 1.0;
}

void ContactLayer::note_motion_of_pairs(const ContactScene& scene) {
  parallel_for(settings_.threads, scene.bodies.size(), [&](std::size_t i) {
    const ContactBody& body = scene.bodies[i];
    const BodyMotion motion = motion_of(scene, body, body.first_point, last_radius_[i]);
    last_radius_[i] = static_cast<float>(body.radius);
    motion_[i] = motion;
    travel_[i] += (norm(motion.mean) + motion.deviation) * 1.000001;
  });
  parallel_for(settings_.threads, pairs_.size(), [&](std::size_t k) {
    SurfacePair& pair = pairs_[k];
    const BodyMotion& a = motion_[pair.a];
    const BodyMotion b = pair.rigid ? BodyMotion{offsets_[pair.b] - last_offsets_[pair.b], 0.0} : motion_[pair.b];
    const double whole = (norm(a.mean - b.mean) + a.deviation + b.deviation) * 1.000001;
    pair.motion += whole;
    pair.patch_motion += std::min(whole, patch_motion(scene, pair));
  });
  know_positions(scene);
  last_offsets_ = offsets_;
}

void ContactLayer::know_positions(const ContactScene& scene) {
  known_at_.resize(scene.position.size());
  const double largest = parallel_max(settings_.threads, known_at_.size(), [&](std::size_t p) {
    const Vec3d& x = scene.position[p];
    known_at_[p] = to_float(x);
    return std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)});
  });
  rounding_ = rounding_of(largest);
}

double ContactLayer::rounding_of(double largest) { return kFloatRounding * std::numbers::sqrt3 * largest; }

double ContactLayer::way_of(const ContactScene& scene, const ContactBody& body, std::uint32_t known_point, float last_radius) const {
  const double grown = growth(body, last_radius);
  double furthest = 0.0;
  for (std::uint32_t p = 0; p < body.point_count; ++p)
    furthest = std::max(furthest, norm(scene.position[body.first_point + p] - to_double(known_at_[known_point + p])) + rounding_ + grown);
  return furthest;
}

void ContactLayer::evaluate_pair(const ContactScene& scene, SurfacePair& pair, PairGradient (&gradient)[2], PointsWorkspace& workspace,
                                 ElementStore& store) {
  const bool held = !scene.bodies[pair.a].moves && (pair.rigid || !scene.bodies[pair.b].moves);
  if (!held && pair.motion - pair.built_at > settings_.skin) rebuild_lists(scene, pair);
  clear_results(pair, {scene.bodies[pair.a].point_count, pair.rigid ? 0 : scene.bodies[pair.b].point_count}, gradient);
  pair.area = 0.0;
  pair.push = {};
  if (held) return;  // nothing to find
  const PairBody body[2] = {view(scene, pair, 0), view(scene, pair, 1)};
  const bool both = !pair.rigid && body[0].topology != nullptr && body[1].topology != nullptr;
  ContactMaterial contact = material_of(scene, pair);
  const ListReach reach = reach_of(pair, contact);
  double own = own_adhesion(pair);  // factor on W
  if (!both && !pair.rigid) {       // a sphere gives way by its own foundation (fields_and_coupling.md, D)
    const bool first = body[0].topology == nullptr;
    const ContactMaterial& sphere = first ? contact : material(scene.bodies[pair.b].material, scene.bodies[pair.a].material);
    const double modulus = own_.stiffness.empty() ? sphere.sphere_modulus : sphere.sphere_modulus * own_.stiffness[first ? pair.a : pair.b];
    contact.law.repulsion = sphere.sphere_stiffness * sphere_foundation(modulus, contact.law.adhesion * own, body[first ? 0 : 1].radius);
    contact.law.gives_way = true;
    contact.law.cap = 0.0;
    own *= sphere.sphere_adhesion;
  }
  double usual = contact.law.adhesion * own;
  if (!pair.rigid) usual = std::max(0.0, usual + both_tensions(scene, pair, &ContactMaterial::tension_drop));
  contact.law.adhesion = contact.regional ? own : usual;  // W may come with the faces
  if (const SisterBond* bond = both ? sister_bond(scene, pair) : nullptr) {
    const double newness = newness_of_interface(bond->age, contact.new_surface);
    if (newness > 0.0) {
      contact.law.adhesion = usual + newness * (both_tensions(scene, pair, &ContactMaterial::tension) - usual);
      contact.regional.reset();
    }
  }
  if (pair.with_itself()) {
    contact.regional.reset();
    contact.law.adhesion = contact.law.cap = 0.0;
  }
  contact.law.adhesion *= bonding_;
  for (int d = 0; d < 2; ++d) {
    if (pair.points[d].empty()) continue;
    evaluate_points({body[d], body[1 - d], contact, FaceQuadrature::with_points(settings_.points_per_face), reach, both ? 0.5 : 1.0,
                     pair.patch_motion, pair.motion - pair.built_at, !pair.rigid, pair.with_itself()},
                    d, pair, gradient, workspace);
    if (!both && !pair.rigid && !packing_.empty())
      add_packing(body[d], body[1 - d], FaceQuadrature::with_points(settings_.points_per_face), packing_[d == 0 ? pair.b : pair.a],
                  kPackingOnset * settings_.range, d, pair, gradient, workspace.elements);
    pair.elements[d] = store.keep(workspace.elements);
  }
  pair.area = gradient[0].contact_area + gradient[1].contact_area;
  if (both) return;
  if (!pair.rigid) {
    const int d = body[0].topology == nullptr ? 1 : 0;
    pair.push = gradient[1 - d].force[0].value();
    pair.within[d] = to_float(virial_about(body[1 - d].node(0), body[d], pair.node[d], gradient[d]));
    return;
  }
  // Areas and normals belong to the cell: their share of its force is zero in sum.
  for (const std::uint16_t node : pair.node[0]) pair.push -= gradient[0].force[node].value();
}

void ContactLayer::find_penetration(const ContactScene& scene, std::span<Penetration> by_body) {
  const std::vector<std::uint32_t>& list = pairs_of_kind_[static_cast<std::size_t>(SurfacePairKind::kWithSphere)];
  std::vector<Penetration> of_pair(list.size());
  parallel_for(settings_.threads, list.size(), [&](std::size_t k) {
    SurfacePair& pair = pairs_[list[k]];
    if (pair.motion - pair.built_at > settings_.skin) rebuild_lists(scene, pair);
    const PairBody body[2] = {view(scene, pair, 0), view(scene, pair, 1)};
    const int d = body[0].topology != nullptr ? 0 : 1;
    std::vector<std::uint32_t> faces;
    pair.points[d].unpack_source_faces(faces);
    of_pair[k] =
        penetration(body[d], body[1 - d], FaceQuadrature::with_points(settings_.points_per_face), faces, kPackingOnset * settings_.range);
  });
  for (std::size_t k = 0; k < list.size(); ++k) {
    const SurfacePair& pair = pairs_[list[k]];
    Penetration& sum = by_body[scene.bodies[pair.a].shape == BodyShape::kSphere ? pair.a : pair.b];
    sum.volume += of_pair[k].volume;
    sum.slope += of_pair[k].slope;
  }
}

void ContactLayer::evaluate(const ContactScene& scene, SurfacePairKind kind, ContactGradient& gradient) {
  assert(!fresh_ && "rebuild() comes first");
  std::vector<ElementStore>& stores = present_[static_cast<std::size_t>(kind)];
  stores.clear();
  stores.resize(static_cast<std::size_t>(settings_.threads));
  evaluate_list(pairs_of_kind_[static_cast<std::size_t>(kind)], {}, scene, stores, gradient);
}

void ContactLayer::evaluate_of(std::span<const char> these, const ContactScene& scene, SurfacePairKind kind, ContactGradient& gradient) {
  assert(!fresh_ && "rebuild() comes first");
  std::vector<std::uint32_t> list;
  for (const std::uint32_t k : pairs_of_kind_[static_cast<std::size_t>(kind)])
    if (these[pairs_[k].a] || (!pairs_[k].rigid && these[pairs_[k].b])) list.push_back(k);
  std::vector<ElementStore>& stores = present_[static_cast<std::size_t>(kind)];
  stores.resize(static_cast<std::size_t>(settings_.threads));
  evaluate_list(list, these, scene, stores, gradient);
}

void ContactLayer::evaluate_list(std::span<const std::uint32_t> list, std::span<const char> these, const ContactScene& scene,
                                 std::vector<ElementStore>& stores, ContactGradient& gradient) {
  const std::size_t threads = static_cast<std::size_t>(settings_.threads);
  const auto is_wanted = [&](std::uint32_t body) { return these.empty() || these[body] != 0; };
  struct Gradients {
    PairGradient of[2];
  };
  if (threads == 1) {
    PointsWorkspace workspace;
    Gradients found;
    for (const std::uint32_t k : list) {
      evaluate_pair(scene, pairs_[k], found.of, workspace, stores[0]);
      for (int side = 0; side < (pairs_[k].rigid ? 1 : 2); ++side)
        if (is_wanted(side == 0 ? pairs_[k].a : pairs_[k].b)) collect(scene, pairs_[k], side, found.of[side], gradient);
    }
    return;
  }
  // A share of the pairs at a time. Their gradients go to the bodies while the next are found, those of a body by one thread and in canonical
  // order.
  const std::size_t share = kPairsOfShare * threads, shares = (list.size() + share - 1) / share;
  std::vector<Gradients> found[2] = {std::vector<Gradients>(share), std::vector<Gradients>(share)};
  const auto last_of = [&](std::size_t number) { return std::min(list.size(), (number + 1) * share); };
#pragma omp parallel num_threads(settings_.threads)
  {
    PointsWorkspace workspace;
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
    const auto team = static_cast<std::size_t>(omp_get_num_threads());  // OMP_THREAD_LIMIT may give fewer than were asked for
    for (std::size_t now = 0; now <= shares; ++now) {
      if (now > 0)
        for (std::size_t k = (now - 1) * share; k < last_of(now - 1); ++k) {
          const SurfacePair& pair = pairs_[list[k]];
          const Gradients& of_pair = found[(now - 1) % 2][k - (now - 1) * share];
          if (pair.a % team == thread && is_wanted(pair.a)) collect(scene, pair, 0, of_pair.of[0], gradient);
          if (!pair.rigid && pair.b % team == thread && is_wanted(pair.b)) collect(scene, pair, 1, of_pair.of[1], gradient);
        }
#pragma omp for schedule(dynamic, 1)
      for (std::size_t k = now * share; k < last_of(now); ++k)
        evaluate_pair(scene, pairs_[list[k]], found[now % 2][k - now * share].of, workspace, stores[thread]);
    }
  }
}

void ContactLayer::collect(const ContactScene& scene, const SurfacePair& pair, int side, const PairGradient& part,
                           ContactGradient& gradient) const {
  const std::uint32_t number = side == 0 ? pair.a : pair.b;
  const ContactBody& body = scene.bodies[number];
  if (!body.owned || (pair.elements[0].empty() && pair.elements[1].empty())) return;
  for (const std::uint16_t node : pair.node[side]) gradient.force[body.first_point + node] += part.force[node].value();
  if (part.has_node_normal)
    for (const std::uint16_t node : pair.node[side]) gradient.node_normal[body.first_point + node] += part.node_normal[node];
  for (std::size_t m = 0; m < part.source_face.size(); ++m) {
    const std::size_t face = scene.first_face[number] + part.source_face[m];
    gradient.face_energy[face] += part.face_energy[m];
    gradient.told_area[face] += part.told_area[m];
  }
}

void ContactGradient::set_zero(std::size_t points, std::size_t surface_points, std::size_t faces) {
  force.assign(points, {});
  node_normal.assign(surface_points, {});
  face_energy.assign(faces, 0.0);
  told_area.assign(faces, 0.0f);
}

double ContactGradient::contact_area(std::span<const Triangle> faces, std::span<const Vec3d> nodes, std::size_t first_face) const {
  double sum = 0.0;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (const auto told = static_cast<double>(told_area[first_face + f]); told > 0.0) {
      const auto [a, b, c] = faces[f];
      sum += std::min(told, 0.5 * norm(cross(nodes[b] - nodes[a], nodes[c] - nodes[a])));
    }
  return sum;
}

std::size_t ContactGradient::memory() const {
  const auto bytes = [](const auto& vector) { return vector.capacity() * sizeof(vector[0]); };
  return bytes(force) + bytes(node_normal) + bytes(face_energy) + bytes(told_area);
}

void ContactLayer::add_energy(const ContactScene& scene, OrderFreeSum& sum) const {
  for (const SurfacePair& pair : pairs_)
    if (scene.bodies[pair.a].owned) sum.add(pair.energy);
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

const SurfacePair* ContactLayer::crossed(const ContactScene& scene, std::span<const Vec3d> start) const {
  if (cap() > 0.0) return nullptr;
  for (const SurfacePair& pair : pairs_) {
    if (pair.crossed > 0) return &pair;
    if (pair.crossed_at == 1e300) continue;
    const ContactBody& body = scene.bodies[pair.a];  // no two of its points have moved against each other by more than the diagonal
    Box ways;
    for (std::uint32_t p = body.first_point; p < body.first_point + body.point_count; ++p) ways.include(scene.position[p] - start[p]);
    if (pair.crossed_at <= norm(ways.high - ways.low)) return &pair;
  }
  return nullptr;
}

std::size_t ContactLayer::memory() const {
  const auto bytes = [](const auto& vector) { return vector.capacity() * sizeof(vector[0]); };
  std::size_t total = bytes(pairs_) + bytes(spheres_) + bytes(pairs_of_kind_[0]) + bytes(pairs_of_kind_[1]) + bytes(motion_) +
                      bytes(last_radius_) + bytes(travel_) + bytes(listed_at_) + bytes(listed_radius_) + bytes(stray_) +
                      bytes(known_bodies_) + bytes(known_at_) + objective_.memory();
  for (const SurfacePair& pair : pairs_)
    for (int d = 0; d < 2; ++d) {
      total += pair.points[d].memory() + bytes(pair.node[d]);
    }
  for (int kind = 0; kind < 2; ++kind)
    for (const auto* stores : {&present_[kind], &step_[kind]})
      for (const ElementStore& store : *stores) total += store.memory();
  return total;
}

}  // namespace morula
