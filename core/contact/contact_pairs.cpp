// Which bodies may touch, and the candidate lists of each pair.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/contact/contact_layer.h"
#include "core/contact/faces_in_box.h"
#include "core/contact/self_contact.h"
#include "core/parallel/threads.h"

namespace morula {

namespace {

constexpr std::uint32_t kGone = 0xFFFFFFFFu;  // instead of a body's number

/// Pairs in canonical order, obstacles and then surfaces themselves last.
std::array<std::uint64_t, 3> key_of(const ContactScene& scene, const SurfacePair& pair) {
  const std::uint64_t kind = pair.rigid ? 1 : pair.with_itself() ? 2 : 0;
  return {kind, scene.bodies[pair.a].place, pair.rigid ? pair.b : scene.bodies[pair.b].place};
}

}  // namespace

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

void ContactLayer::add_self_pairs(const ContactScene& scene) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
    const ContactBody& body = scene.bodies[i];
    if (body.shape == BodyShape::kSurface && body.owned && material(body.material, body.material).self_distance > 0.0) found.push_back(i);
  }
  std::sort(found.begin(), found.end(), [&](std::uint32_t i, std::uint32_t j) { return scene.bodies[i].place < scene.bodies[j].place; });
  for (const std::uint32_t i : found) {
    SurfacePair& pair = pairs_.emplace_back();
    pair.a = pair.b = i;
  }
}

void ContactLayer::renumber(const ContactScene& scene) {
  struct Now {
    std::uint32_t number = kGone;
    BodyMotion motion;
  };
  std::vector<std::pair<std::uint32_t, Now>> now;  // by number at the last rebuild()
  for (std::uint32_t i = 0; i < scene.bodies.size() && !known_bodies_.empty(); ++i) {
    const ContactBody& body = scene.bodies[i];
    const auto before = std::ranges::lower_bound(known_bodies_, body.id, {}, &KnownBody::id);
    if (before == known_bodies_.end() || before->id != body.id || before->topology != scene.topology_of(i)) continue;
    now.push_back({before->number, {i, motion_of(scene, body, before->first_point, last_radius_[before->number])}});
  }
  std::ranges::sort(now, {}, [](const auto& entry) { return entry.first; });
  const auto find = [&](std::uint32_t number) {
    const auto at = std::ranges::lower_bound(now, number, {}, [](const auto& entry) { return entry.first; });
    return at != now.end() && at->first == number ? at->second : Now{};
  };
  std::vector<SurfacePair> kept;
  for (SurfacePair& pair : pairs_) {
    const Now a = find(pair.a), b = pair.rigid ? Now{pair.b, {offsets_[pair.b] - last_offsets_[pair.b], 0.0}} : find(pair.b);
    if (a.number == kGone || b.number == kGone) continue;
    if (!pair.rigid && scene.bodies[a.number].place > scene.bodies[b.number].place) continue;  // each would be in the other's lists
    const double whole = (norm(a.motion.mean - b.motion.mean) + a.motion.deviation + b.motion.deviation) * 1.000001;
    pair.a = a.number, pair.b = b.number;
    pair.motion += whole;
    pair.patch_motion += whole;
    pair.at_start = false;
    for (int d = 0; d < 2; ++d) pair.elements[d] = pair.step_elements[d] = {};
    kept.push_back(std::move(pair));
  }
  const auto before = [&](const SurfacePair& p, const SurfacePair& q) { return key_of(scene, p) < key_of(scene, q); };
  if (!std::ranges::is_sorted(kept, before)) std::ranges::sort(kept, before);
  pairs_ = std::move(kept);
}

void ContactLayer::rebuild(const ContactScene& scene, const Space& space) {
  if (fresh_) renumber(scene);
  const std::size_t n = scene.bodies.size();
  std::vector<Extent> extents(n);
  std::vector<std::uint32_t> place(n);
  std::vector<char> owned(n);
  parallel_for(settings_.threads, n, [&](std::size_t i) {
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
  });
  spheres_.clear();
  spheres_.reserve(sphere_pairs_before_ + sphere_pairs_before_ / 64);  // no growth by doubling in most rebuilds
  std::vector<SurfacePair> old = std::move(pairs_);
  pairs_.clear();
  find_body_pairs(extents, place, owned, space, [&](const BodyPair& found) {
    const bool spheres = scene.bodies[found.a].shape == BodyShape::kSphere && scene.bodies[found.b].shape == BodyShape::kSphere;
    if (spheres) {
      spheres_.push_back({found.a, found.b});
    } else {
      SurfacePair& pair = pairs_.emplace_back();
      pair.a = found.a;
      pair.b = found.b;
      pair.shift = found.shift;
    }
  });
  sphere_pairs_before_ = spheres_.size();
  add_obstacle_pairs(scene);
  add_self_pairs(scene);
  keep_lists(scene, std::move(old));
}

void ContactLayer::rebuild(const ContactScene& scene, std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs) {
  std::vector<SurfacePair> old;
  if (!fresh_) old = std::move(pairs_);
  pairs_.clear();
  spheres_.clear();
  for (const auto& [a, b] : pairs) {
    SurfacePair& pair = pairs_.emplace_back();
    pair.a = a;
    pair.b = b;
  }
  keep_lists(scene, std::move(old));
}

void ContactLayer::keep_lists(const ContactScene& scene, std::vector<SurfacePair> old) {
  const std::size_t n = scene.bodies.size();
  pairs_.shrink_to_fit();
  auto before = old.begin();  // keep the lists of pairs that stay; both sequences come in the order of their keys
  for (SurfacePair& pair : pairs_) {
    while (before != old.end() && key_of(scene, *before) < key_of(scene, pair)) ++before;
    if (before != old.end() && key_of(scene, *before) == key_of(scene, pair) && before->shift == pair.shift) pair = std::move(*before);
  }
  for (auto& list : pairs_of_kind_) list.clear();
  for (std::uint32_t k = 0; k < pairs_.size(); ++k) {
    const auto is_sphere = [&](std::uint32_t body) { return scene.bodies[body].shape == BodyShape::kSphere; };
    const bool with_sphere = !pairs_[k].rigid && (is_sphere(pairs_[k].a) || is_sphere(pairs_[k].b));
    pairs_of_kind_[with_sphere ? 1 : 0].push_back(k);
  }
  for (int kind = 0; kind < 2; ++kind)
    if (pairs_of_kind_[kind].empty()) present_[kind].clear(), step_[kind].clear();
  if (pairs_.empty()) {  // spheres alone: they need no motions
    std::vector<BodyMotion>().swap(motion_);
    std::vector<double>().swap(travel_);
  } else {
    motion_.assign(n, {});
    travel_.assign(n, 0.0);
  }
  know_bodies(scene);
  know_positions(scene);
  last_offsets_ = offsets_;
  last_radius_.resize(n);
  for (std::size_t i = 0; i < n; ++i) last_radius_[i] = static_cast<float>(scene.bodies[i].radius);
  obstacle_travel_ = 0.0;
  fresh_ = false;
}

void ContactLayer::know_bodies(const ContactScene& scene) {
  std::vector<char> in_pair(pairs_.empty() ? 0 : scene.bodies.size(), 0);
  for (const SurfacePair& pair : pairs_) {
    in_pair[pair.a] = 1;
    if (!pair.rigid) in_pair[pair.b] = 1;
  }
  known_bodies_.clear();
  for (std::uint32_t i = 0; i < in_pair.size(); ++i)
    if (in_pair[i]) known_bodies_.push_back({scene.bodies[i].id, i, scene.bodies[i].first_point, scene.topology_of(i)});
  std::ranges::sort(known_bodies_, {}, &KnownBody::id);
}

void ContactLayer::rebuild_lists(const ContactScene& scene, SurfacePair& pair) {
  const PairBody body[2] = {view(scene, pair, 0), view(scene, pair, 1)};
  const ContactMaterial& contact = material_of(scene, pair);
  const ListReach reach = reach_of(pair, contact);
  std::vector<std::uint32_t> faces[2];
  for (int which = 0; which < 2; ++which) {
    if (body[which].topology == nullptr) continue;
    Box other;
    const PairBody& o = body[1 - which];
    if (pair.rigid && which == 0) continue;  // nothing is held against the cell's faces
    for (std::uint32_t i = 0; i < o.position.size(); ++i) other.include(o.node(i));
    other = other.inflated(o.radius + reach.candidates());
    if (pair.rigid) {
      const Box there{other.low - body[1].shift, other.high - body[1].shift};
      faces[1] = obstacles_[pair.b].tree->faces_in(there);
      continue;
    }
    faces_in_box(body[which], other, faces[which]);
  }
  PointsAgainstBody lists[2], old;
  for (int d = 0; d < 2; ++d) {
    lists[d].clear();
    if (body[d].topology != nullptr && !(d == 1 && (pair.rigid || pair.with_itself()))) {
      const int rings = pair.with_itself() ? self_contact_rings(body[0].topology->face_count(), contact.self_radius, reach.range) : 0;
      pair.points[d].unpack(old);
      build_point_lists(body[d], body[1 - d], reach, settings_.points_per_face, faces[1 - d], old, pair.patch_motion,
                        pair.motion - pair.built_at, lists[d], rings);
    }
    pair.points[d].pack(lists[d]);
  }
  collect_pair_nodes(body[0].topology, body[1].topology, lists, pair);
  pair.built_at = pair.motion;
  pair.patch_motion = 0.0;
}

}  // namespace morula
