#include "coupling/mechanics/sphere_contacts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cbm/sphere_range.h"
#include "core/ball.h"
#include "core/parallel/threads.h"
#include "coupling/mechanics/contact_setup.h"
#include "coupling/mechanics/own_contacts.h"

namespace morula {
namespace {

double arm_of_a(const cbm::PairBlock& block, int lane) {
  return cbm::contact_arm(block.distance[lane], block.radius_a[lane], block.radius_b[lane]);
}
double arm_of_b(const cbm::PairBlock& block, int lane) {
  return cbm::contact_arm(block.distance[lane], block.radius_b[lane], block.radius_a[lane]);
}

}  // namespace

SphereContacts::SphereContacts(const Model& model, SurfaceContacts& surfaces)
    : model_(model), surfaces_(surfaces), table_(sphere_contact_table(model)) {
  std::vector<PairFriction> friction;
  for (std::size_t a = 0; a < table_.type_count(); ++a)
    for (std::size_t b = 0; b < table_.type_count(); ++b) {
      const auto& entry = table_.entry(a, b);
      friction.push_back(
          {static_cast<float>(entry.tangential_friction), static_cast<float>(entry.normal_friction - entry.tangential_friction)});
    }
  list_.set_friction(std::move(friction), table_.type_count());
  for (const CellType& type : model_.types) packing_.acts = packing_.acts || !type.sphere.packing.empty();
  note_curved_obstacles();
}

template <class Wanted, class Sink, class FarAway>
void SphereContacts::visit(const SpherePairs::Share& share, const Scene& scene, Wanted&& wanted, Sink&& sink, FarAway&& far_away) const {
  const Vec3d* x = scene.position().data() + scene.sphere_point();
  const ContactBody* body = scene.bodies().data() + scene.first_sphere();
  const bool periodic = model_.space.any_periodic();
  const double reach = layer().settings().sphere_reach + 1e-6;
  cbm::PairBlock block;
  OwnContacts own(model_, table_, layer().own_factors());
  cbm::PairContact of_lane[cbm::PairBlock::kWidth];  // where spheres differ from their types
  const std::size_t first = scene.first_sphere();
  std::uint32_t number[cbm::PairBlock::kWidth];
  int filled = 0;
  const auto flush = [&] {
    if (filled == 0) return;
    cbm::evaluate(block, filled);
    for (int lane = 0; lane < filled; ++lane) sink(number[lane], block, lane);
    filled = 0;
  };
  for (const SpherePairs::Run& run : share.runs) {
    auto sisters =
        std::lower_bound(sisters_.begin(), sisters_.end(), run.first, [](const Sisters& s, std::uint32_t k) { return s.pair < k; });
    for (std::uint32_t k = run.first; k < run.last; ++k) {
      const SpherePair pair = list_.pairs[k];
      double offset = 0.0;
      if (sisters != sisters_.end() && sisters->pair == k) offset = (sisters++)->offset;
      if (!wanted(pair)) continue;
      const ContactBody &a = body[pair.a], &b = body[pair.b];
      Vec3d between = x[pair.b] - x[pair.a];
      if (periodic) between = model_.space.nearest_image(between);
      const double far = a.radius + b.radius + (pair.attached ? reach : 1e-6);
      if (norm2(between) < far * far) {
        number[filled] = k;
        const cbm::PairContact* contact = &table_.entry(a.material, b.material).contact;
        if (own.vary()) contact = &(of_lane[filled] = own.of(a, first + pair.a, b, first + pair.b));
        block.set(filled++, between, a.radius, b.radius, *contact, pair.attached, offset);
        if (filled == cbm::PairBlock::kWidth) flush();
      } else {  // most of what the skin adds
        far_away(k);
      }
    }
  }
  flush();
}

void SphereContacts::set_element(SpherePairElement& element, const cbm::PairBlock& block, int lane) const {
  element.stiffness = static_cast<float>(block.stiffness[lane]);
  if (friction_is_frozen_ && element.area != 0.0f) return;  // the friction of the step's start goes on
  for (int axis = 0; axis < 3; ++axis) element.n[axis] = static_cast<float>(block.normal[axis][lane]);
  element.area = friction_is_frozen_ ? 0.0f : static_cast<float>(block.area[lane]);
}

void SphereContacts::measure(const World& world) {
  if (list_number_ != surfaces_.list_number()) {
    set_pairs(world);
    list_number_ = surfaces_.list_number();
  }
  if (!packing_.acts) return;
  const ContactScene scene = contact_scene(world);
  const bool with_surfaces = layer().has_pairs(SurfacePairKind::kWithSphere);
  std::vector<Penetration> penetration(with_surfaces ? scene.bodies.size() : 0);
  if (with_surfaces) surfaces_.layer().find_penetration(scene, penetration);
  find_packing(world.scene, penetration, world.comm);
  surfaces_.layer().set_packing(packing_.on_surfaces);
}

void SphereContacts::evaluate_share(std::size_t number, const Scene& scene, Vec3d* to, OrderFreeSum& energy) {
  const SpherePairs::Share& share = list_.shares()[number];
  std::vector<std::uint32_t>& flips = adhesion_.flips[number];
  const auto owned = static_cast<std::uint32_t>(scene.owned_spheres());
  const auto writes = [&](const SpherePair& pair) { return pair.a < owned ? share.has(pair.a) : share.has(pair.b); };  // one thread only
  flips.clear();
  std::uint32_t sphere = 0;
  double of_sphere = 0.0;  // pairs that come first under one sphere: their order is canonical, so they may be added up in double
  visit(
      share, scene, [](const SpherePair&) { return true; },
      [&](std::uint32_t k, const cbm::PairBlock& block, int lane) {
        const SpherePair pair = list_.pairs[k];
        PackingForce pressed;
        if (packing_.acts) pressed = packing_force(scene, pair, block.distance[lane] + block.offset[lane]);
        const double size = block.force[lane] + pressed.force;
        const Vec3d f = Vec3d{block.normal[0][lane], block.normal[1][lane], block.normal[2][lane]} * size;
        if (share.has(pair.a)) {
          to[pair.a] -= f;
          virial_[pair.a] += arm_of_a(block, lane) * size;
          if (pair.a != sphere) {
            energy.add(of_sphere);
            of_sphere = 0.0;
            sphere = pair.a;
          }
          of_sphere += block.energy[lane];
        }
        if (share.has(pair.b)) {
          to[pair.b] += f;
          virial_[pair.b] += arm_of_b(block, lane) * size;
        }
        if (!writes(pair)) return;
        if (block.attached_next[lane] != (pair.attached != 0)) flips.push_back(k);
        set_element(list_.elements[k], block, lane);
        if (!packing_.acts) return;
        list_.elements[k].stiffness += static_cast<float>(pressed.stiffness);
        list_.packing.slopes[k] = {static_cast<float>(pressed.caps.slope_a), static_cast<float>(pressed.caps.slope_b)};
      },
      [&](std::uint32_t k) {
        const SpherePair pair = list_.pairs[k];
        if (!writes(pair)) return;
        if (pair.attached) flips.push_back(k);
        list_.elements[k].stiffness = 0.0f;
        if (!friction_is_frozen_) list_.elements[k].area = 0.0f;
      });
  energy.add(of_sphere);
}

void SphereContacts::evaluate(const World& world, Forces& out) {
  const Scene& scene = world.scene;
  const auto owned = static_cast<std::uint32_t>(scene.owned_spheres());
  Vec3d* to = out.force.data() + scene.sphere_point();
  virial_.assign(owned, 0.0);
  std::vector<OrderFreeSum> energy(std::max<std::size_t>(1, list_.shares().size()));
  adhesion_.flips.resize(list_.shares().size());
  if (packing_.acts) list_.packing.slopes.assign(list_.pairs.size(), {});
  on_each_thread(threads(), [&](std::size_t t) { evaluate_share(t, scene, to, energy[t]); });
  for (const OrderFreeSum& of_share : energy) out.energy += of_share;

  parallel_for(threads(), rigid_.size(), [&](std::size_t k) { evaluate_rigid(scene, k); });
  for (const RigidPair& pair : rigid_) {
    to[pair.sphere] -= pair.normal * pair.force;
    virial_[pair.sphere] += pair.distance * pair.force;
    out.energy.add(pair.energy);
  }
  for (std::uint32_t i = 0; packing_.acts && i < owned; ++i) {
    const ContactBody& body = scene.bodies()[scene.first_sphere() + i];
    out.energy.add(ball_volume(body.radius) * model_.types[body.material].sphere.packing.at(packing_.part[i]).energy);
  }
}

void SphereContacts::mark(std::vector<char>& marked, const Scene& scene, std::uint32_t sphere) {
  if (marked.empty()) marked.assign(scene.bodies().size() - scene.first_sphere(), 0);
  marked[sphere] = 1;
}

SpherePairs::Share SphereContacts::marked_part(const SpherePairs::Share& share, const std::vector<char>& marked) const {
  SpherePairs::Share out{share.first, share.last, {}};
  for (const SpherePairs::Run& run : share.runs)
    for (std::uint32_t k = run.first; k < run.last; ++k) {
      const SpherePair pair = list_.pairs[k];
      if ((marked[pair.a] | marked[pair.b]) == 0) continue;
      if (!out.runs.empty() && out.runs.back().last == k)
        ++out.runs.back().last;
      else
        out.runs.push_back({k, k + 1});
    }
  return out;
}

void SphereContacts::refresh_values(const Scene& scene, const std::vector<char>& marked) {
  for (std::size_t i = 0; i < scene.owned_spheres(); ++i)
    if (marked[i]) virial_[i] = 0.0;
  const auto shares = list_.shares();
  on_each_thread(threads(), [&](std::size_t t) {
    const SpherePairs::Share share = marked_part(shares[t], marked);
    visit(
        share, scene, [](const SpherePair&) { return true; },
        [&](std::uint32_t k, const cbm::PairBlock& block, int lane) {
          const SpherePair pair = list_.pairs[k];
          for (const std::uint32_t i : {pair.a, std::uint32_t{pair.b}}) {
            if (!marked[i] || !share.has(i)) continue;
            const double pressed = packing_.acts ? packing_force(scene, pair, block.distance[lane] + block.offset[lane]).force : 0.0;
            virial_[i] += (i == pair.a ? arm_of_a(block, lane) : arm_of_b(block, lane)) * (block.force[lane] + pressed);
          }
        },
        [](std::uint32_t) {});
  });
  for (std::size_t k = 0; k < rigid_.size(); ++k) {
    const RigidPair& pair = rigid_[k];
    if (!marked[pair.sphere]) continue;
    evaluate_rigid(scene, k);
    virial_[pair.sphere] += pair.distance * pair.force;
  }
}

void SphereContacts::end_step(const World& world, StepEnd& end) {
  if (end.clock_runs) update_attached(world, end.tissue);
  adhesion_.young.clear();
  friction_is_frozen_ = false;
}

bool SphereContacts::update_attached(const World& world, Tissue& tissue) {
  const Scene& scene = world.scene;
  std::vector<char> marked;
  const auto mark = [&](std::uint32_t i) { SphereContacts::mark(marked, scene, i); };
  for (auto& flips : adhesion_.flips) {
    for (const std::uint32_t k : flips) {
      SpherePair& pair = list_.pairs[k];
      set_attached(pair, pair.attached == 0);
      mark(pair.a);
      mark(pair.b);
    }
    flips.clear();
  }
  for (std::size_t k = 0, next = 0; k < rigid_.size(); k = next) {
    bool attached = false;
    for (; next < rigid_.size() && rigid_[next].same_bodies(rigid_[k]); ++next) attached = attached || rigid_[next].attached_next;
    if (attached == rigid_[k].attached) continue;
    for (std::size_t part = k; part < next; ++part) rigid_[part].attached = attached;
    mark(rigid_[k].sphere);
  }
  const bool changed = !marked.empty();
  if (changed) refresh_values(scene, marked);
  if (adhesion_.partners_are_lost) mark_other_partners(scene, tissue, mark);
  for (const std::uint32_t sphere : adhesion_.lost) mark(sphere);
  if (!marked.empty()) write_partners(scene, marked, tissue);
  adhesion_.partners_are_lost = false;
  adhesion_.lost.clear();
  return changed;
}

template <class Mark>
void SphereContacts::mark_other_partners(const Scene& scene, const Tissue& tissue, const Mark& mark) const {
  struct Sum {  // over the partners, in any order; other partners have another sum
    std::uint64_t mixed = 0;
    std::uint32_t count = 0;
    void add(CellId id) { mixed += id.bits() * 0x9E3779B97F4A7C15u ^ id.bits() >> 29, ++count; }
    bool operator==(const Sum&) const = default;
  };
  std::vector<Sum> by_flags(scene.owned_spheres());
  for_attached(scene, [&](std::uint32_t i, CellId partner) { by_flags[i].add(partner); });
  for (std::uint32_t i = 0; i < by_flags.size(); ++i) {
    Sum listed;
    for (const CellId partner : tissue.spheres.attached[i]) listed.add(partner);
    if (listed != by_flags[i]) mark(i);
  }
}

std::vector<SphereContacts::Pressing> SphereContacts::pressing(const Scene& scene) const {
  std::vector<Pressing> out(scene.owned_spheres());
  const auto shares = list_.shares();
  on_each_thread(threads(), [&](std::size_t t) {
    visit(
        shares[t], scene, [](const SpherePair&) { return true; },
        [&](std::uint32_t k, const cbm::PairBlock& block, int lane) {
          const SpherePair pair = list_.pairs[k];
          const Vec3d normal{block.normal[0][lane], block.normal[1][lane], block.normal[2][lane]};
          double force = block.force[lane];
          if (packing_.acts) force += packing_force(scene, pair, block.distance[lane] + block.offset[lane]).force;
          for (const std::uint32_t i : {pair.a, std::uint32_t{pair.b}}) {
            if (!shares[t].has(i)) continue;
            out[i].with_cells += block.area[lane];
            out[i].virial += outer((i == pair.a ? arm_of_a(block, lane) : arm_of_b(block, lane)) * force, normal);
          }
        },
        [](std::uint32_t) {});
  });
  for (const RigidPair& pair : rigid_) {
    out[pair.sphere].with_obstacles += pair.area;
    out[pair.sphere].virial += outer(pair.distance * pair.force, pair.normal);
  }
  return out;
}

std::vector<SphereContacts::Standing> SphereContacts::standings(const Scene& scene) const {
  const ContactBody* body = scene.bodies().data() + scene.first_sphere();
  std::vector<Standing> out(scene.owned_spheres());
  const auto shares = list_.shares();
  on_each_thread(threads(), [&](std::size_t t) {
    visit(
        shares[t], scene, [](const SpherePair&) { return true; },
        [&](std::uint32_t k, const cbm::PairBlock& block, int lane) {
          const SpherePair pair = list_.pairs[k];
          const double a = body[pair.a].radius, b = body[pair.b].radius, distance = block.distance[lane] + block.offset[lane];
          const bool touch = block.area[lane] > 0.0;
          const double part = touch ? cbm::part_of_range(*block.contact[lane], a + b - distance, block.area[lane], std::min(a, b)) : 0.0;
          const cbm::SphereCaps caps = cbm::sphere_caps(a, b, distance);
          for (const std::uint32_t i : {pair.a, std::uint32_t{pair.b}}) {
            if (!shares[t].has(i)) continue;
            out[i].outside = std::max(out[i].outside, part);
            out[i].caps += i == pair.a ? caps.volume_a : caps.volume_b;
          }
        },
        [](std::uint32_t) {});
  });
  for (const RigidPair& pair : rigid_) {
    if (!(pair.area > 0.0)) continue;
    const ContactBody& sphere = body[pair.sphere];
    const double overlap = sphere.radius - pair.distance;
    Standing& sum = out[pair.sphere];
    sum.outside = std::max(sum.outside, cbm::part_of_range(contact_with_obstacle(scene, pair), overlap, pair.area, sphere.radius));
    sum.caps += cbm::plane_cap(sphere.radius, overlap).volume;
  }
  return out;
}

SphereRangeCount SphereContacts::count_beyond_range(const Scene& scene) const {
  const ContactBody* body = scene.bodies().data() + scene.first_sphere();
  const auto shares = list_.shares();
  std::vector<SphereRangeCount> by_thread(shares.size());
  on_each_thread(threads(), [&](std::size_t t) {
    visit(
        shares[t], scene, [&](const SpherePair& pair) { return shares[t].has(pair.a); },
        [&](std::uint32_t k, const cbm::PairBlock& block, int lane) {
          if (!(block.area[lane] > 0.0)) return;
          const SpherePair pair = list_.pairs[k];
          ++by_thread[t].contacts;
          const double a = body[pair.a].radius, b = body[pair.b].radius;
          const double overlap = a + b - block.distance[lane] - block.offset[lane];
          by_thread[t].beyond += cbm::is_outside_law(*block.contact[lane], overlap, block.area[lane], std::min(a, b));
        },
        [](std::uint32_t) {});
  });
  SphereRangeCount out;
  for (const SphereRangeCount& count : by_thread) out.contacts += count.contacts, out.beyond += count.beyond;
  return out;
}

std::size_t SphereContacts::memory() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return list_.memory() + bytes(sisters_) + bytes(rigid_) + bytes(adhesion_.count) + bytes(virial_) + bytes(packing_.part) +
         bytes(packing_.pressure) + bytes(packing_.on_surfaces);  // flips: a handful
}

void SphereFriction::begin_step(const World& world, StepStart& start) {
  const cbm::Spheres& spheres = world.tissue.spheres;
  parallel_for(world.threads, spheres.size(), [&](std::size_t i) {
    const double r = spheres.radius[i];
    start.point_friction[i] = static_cast<float>(world.model.types[spheres.type[i]].medium_friction * 4.0 * std::numbers::pi * r * r);
  });
  medium_ = start.point_friction.first(spheres.size());
}

void SphereFriction::add_friction(const World& world, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) {
  const std::vector<Vec3d> of_obstacles = contacts_.obstacle_ways();
  if (!way.moved && std::ranges::all_of(of_obstacles, [](const Vec3d& d) { return norm2(d) == 0.0; })) return;
  const auto threads = static_cast<std::size_t>(std::max(1, world.threads));
  std::vector<OrderFreeSum> sums(threads);
  on_each_thread(world.threads, [&](std::size_t t) {
    for (std::size_t i = medium_.size() * t / threads; i < medium_.size() * (t + 1) / threads; ++i) {
      const std::size_t point = world.scene.sphere_point() + i;
      const Vec3d d = way.position[point] - way.start[point];
      out[point] += d * static_cast<double>(medium_[i]);
      sums[t].add(static_cast<double>(medium_[i]) * norm2(d));
    }
  });
  for (const OrderFreeSum& sum : sums) quadratic += sum;
  contacts_.pairs().add_friction(way.start, way.position, of_obstacles, out, quadratic);
}

}  // namespace morula
