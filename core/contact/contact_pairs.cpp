// Which bodies may touch, and the candidate lists of each pair.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/contact/contact_layer.h"
#include "core/contact/faces_in_box.h"
#include "core/contact/self_contact.h"
#include "core/parallel/threads.h"

namespace morula {

namespace {

constexpr std::uint32_t kGone = 0xFFFFFFFFu;  // instead of a body's number

}  // namespace

void ContactLayer::add_obstacle_pairs(const ContactScene& scene, const Space& space, std::span<const std::uint32_t> bodies) {
  if (obstacles_.empty()) return;
  const double distance = reach().candidates() + settings_.body_skin;
  for (const std::uint32_t i : bodies) {
    const ContactBody& body = scene.bodies[i];
    if (!body.owned) continue;
    Box box;
    for (std::uint32_t p = 0; p < body.point_count; ++p) box.include(scene.position[body.first_point + p]);
    box = box.inflated(distance);
    for (std::uint32_t o = 0; o < obstacles_.size(); ++o)
      for_images(obstacles_[o], offsets_[o], space, box, [&](const SurfaceImage& image) {
        const Vec3d there = offsets_[o] + image.shift;
        if (obstacles_[o].tree->faces_in({box.low - there, box.high - there}).empty()) return;
        SurfacePair& pair = pairs_.emplace_back();
        pair.a = i;
        pair.b = o;
        pair.rigid = true;
        pair.shift = image.shift;
        pair.image = image.number;
      });
  }
}

void ContactLayer::add_self_pairs(const ContactScene& scene, std::span<const std::uint32_t> bodies) {
  for (const std::uint32_t i : bodies) {
    const ContactBody& body = scene.bodies[i];
    if (!body.owned || !(material(body.material, body.material).self_distance > 0.0)) continue;
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
  const auto before = [&](const SurfacePair& p, const SurfacePair& q) { return pair_key(scene, p) < pair_key(scene, q); };
  if (!std::ranges::is_sorted(kept, before)) std::ranges::sort(kept, before);
  pairs_ = std::move(kept);
}

Extent ContactLayer::extent_of(const ContactScene& scene, std::uint32_t number) const {
  const ContactBody& body = scene.bodies[number];
  Extent extent;
  for (std::uint32_t p = 0; p < body.point_count; ++p) extent.box.include(scene.position[body.first_point + p]);
  const bool sphere = body.shape == BodyShape::kSphere;
  const double reach =
      0.5 * (settings_.body_skin + (sphere ? std::max(settings_.range, settings_.sphere_reach) : settings_.range)) + slack_of(number);
  extent.box = extent.box.inflated(reach + body.radius);
  extent.center = extent.box.center();
  double radius2 = 0.0;
  for (std::uint32_t p = 0; p < body.point_count; ++p)
    radius2 = std::max(radius2, norm2(scene.position[body.first_point + p] - extent.center));
  extent.radius = std::sqrt(radius2) + reach + body.radius;
  return extent;
}

void ContactLayer::add_body_pairs(const ContactScene& scene, const Space& space, std::span<const std::uint32_t> wanted) {
  const std::size_t n = scene.bodies.size();
  std::vector<Extent> extents;
  std::vector<std::uint32_t> place, number;  // number: of the bodies that are looked at; empty: all
  const auto take = [&](const BodyPair& found) {
    const std::uint32_t a = number.empty() ? found.a : number[found.a], b = number.empty() ? found.b : number[found.b];
    const ContactBody &first = scene.bodies[a], &second = scene.bodies[b];
    if (!first.owned && !second.owned) return;
    if (first.shape == BodyShape::kSphere && second.shape == BodyShape::kSphere) {
      spheres_.push_back({a, b});
    } else {
      SurfacePair& pair = pairs_.emplace_back();
      pair.a = a;
      pair.b = b;
      pair.shift = found.shift;
    }
  };
  const auto note_widest = [&] {
    for (const Extent& extent : extents) widest_ = std::max(widest_, 2.0 * extent.radius);
  };
  if (wanted.empty()) {
    std::vector<char> owned(n);
    extents.resize(n), place.resize(n);
    parallel_for(settings_.threads, n, [&](std::size_t i) {
      place[i] = scene.bodies[i].place;
      owned[i] = scene.bodies[i].owned;
      extents[i] = extent_of(scene, static_cast<std::uint32_t>(i));
    });
    note_widest();
    return find_body_pairs(extents, place, owned, space, settings_.threads, take);
  }
  std::vector<Extent> of_surfaces(scene.topology.size());  // those of spheres are found twice sooner than kept
  parallel_for(settings_.threads, of_surfaces.size(),
               [&](std::size_t i) { of_surfaces[i] = extent_of(scene, static_cast<std::uint32_t>(i)); });
  const double reach = 0.5 * (settings_.body_skin + std::max(settings_.range, settings_.sphere_reach));
  number = bodies_near(
      wanted, n,
      [&](std::uint32_t i) {
        if (i < of_surfaces.size()) return Ball{of_surfaces[i].center, of_surfaces[i].radius};
        const ContactBody& body = scene.bodies[i];
        return Ball{scene.position[body.first_point], reach + body.radius + slack_of(i)};
      },
      space);
  std::ranges::sort(number, {}, [&](std::uint32_t i) { return scene.bodies[i].place; });
  std::vector<std::uint32_t> some;
  extents.resize(number.size()), place.resize(number.size());
  std::iota(place.begin(), place.end(), 0u);
  for (std::uint32_t k = 0; k < number.size(); ++k)
    if (std::ranges::binary_search(wanted, number[k])) some.push_back(k);
  parallel_for(settings_.threads, number.size(), [&](std::size_t k) { extents[k] = extent_of(scene, number[k]); });
  note_widest();
  find_body_pairs_of(some, extents, place, space, settings_.threads, take);
}

namespace {

/// Surfaces in canonical order.
std::vector<std::uint32_t> surfaces_in_order(const ContactScene& scene) {
  std::vector<std::uint32_t> out(scene.topology.size());
  std::iota(out.begin(), out.end(), 0u);
  std::ranges::sort(out, {}, [&](std::uint32_t i) { return scene.bodies[i].place; });
  return out;
}

}  // namespace

void ContactLayer::rebuild(const ContactScene& scene, const Space& space) {
  ++times_rebuilt_;
  if (fresh_) renumber(scene);
  stray_.clear();
  widest_ = 0.0;
  periodic_ = space.any_periodic();
  spheres_.clear();
  spheres_.reserve(sphere_pairs_before_ + sphere_pairs_before_ / 64);  // no growth by doubling in most rebuilds
  std::vector<SurfacePair> old = std::move(pairs_);
  pairs_.clear();
  add_body_pairs(scene, space, {});
  sphere_pairs_before_ = spheres_.size();
  const std::vector<std::uint32_t> surfaces = surfaces_in_order(scene);
  add_obstacle_pairs(scene, space, surfaces);
  add_self_pairs(scene, surfaces);
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
    while (before != old.end() && pair_key(scene, *before) < pair_key(scene, pair)) ++before;
    if (before != old.end() && pair_key(scene, *before) == pair_key(scene, pair) && before->shift == pair.shift) pair = std::move(*before);
  }
  sort_kinds(scene);
  if (pairs_.empty()) {  // spheres alone: they need no motions
    std::vector<BodyMotion>().swap(motion_);
    std::vector<double>().swap(travel_);
    std::vector<Vec3f>().swap(listed_at_);
    std::vector<float>().swap(listed_radius_);
  } else {
    motion_.assign(n, {});
    travel_.assign(n, 0.0);
  }
  know_bodies(scene);
  know_positions(scene);
  last_offsets_ = offsets_;
  last_radius_.resize(n);
  for (std::size_t i = 0; i < n; ++i) last_radius_[i] = static_cast<float>(scene.bodies[i].radius);
  if (!travel_.empty()) {
    listed_radius_ = last_radius_;
    listed_at_.resize(n);
    parallel_for(settings_.threads, n, [&](std::size_t i) { listed_at_[i] = known_at_[scene.bodies[i].first_point]; });
  }
  stray_.assign(n, 0.0f);
  drift_ = {};
  obstacle_travel_ = 0.0;
  fresh_ = false;
}

void ContactLayer::sort_kinds(const ContactScene& scene) {
  for (auto& list : pairs_of_kind_) list.clear();
  for (std::uint32_t k = 0; k < pairs_.size(); ++k) {
    const auto is_sphere = [&](std::uint32_t body) { return scene.bodies[body].shape == BodyShape::kSphere; };
    const bool with_sphere = !pairs_[k].rigid && (is_sphere(pairs_[k].a) || is_sphere(pairs_[k].b));
    pairs_of_kind_[with_sphere ? 1 : 0].push_back(k);
  }
  for (int kind = 0; kind < 2; ++kind)
    if (pairs_of_kind_[kind].empty()) present_[kind].clear(), step_[kind].clear();
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
  const int rings = pair.with_itself() ? self_contact_rings(body[0].topology->face_count(), contact.self_radius, reach.range) : 0;
  const bool out_of_reach =
      pair.with_itself() && !may_meet_itself(body[0], reach.range + reach.skin, rings);  // until the lists are made anew
  std::vector<std::uint32_t> faces[2];
  for (int which = 0; which < 2; ++which) {
    if (body[which].topology == nullptr || out_of_reach) continue;
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
