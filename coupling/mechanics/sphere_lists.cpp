/// The lists of SphereContacts: which pairs there are, and who adheres to whom.
#include <algorithm>
#include <tuple>

#include "cbm/division_ramp.h"
#include "coupling/mechanics/sphere_contacts.h"

namespace morula {
namespace {

/// An obstacle is a partner too: its number stands where a cell's id would; no founder has so small a one.
CellId obstacle_partner(std::uint32_t obstacle) { return CellId(obstacle + 1); }

bool rubs(const RigidPairElement& element) { return element.isotropic != 0.0f || element.axial != 0.0f; }

}  // namespace

CellId SphereContacts::partner_id(const Scene& scene, std::uint32_t sphere) const {
  return scene.bodies()[scene.first_sphere() + sphere].id;
}

void SphereContacts::set_pairs(const Scene& scene, const Tissue& tissue) {
  std::vector<SpherePair> old_pairs;
  std::vector<SpherePairElement> old_elements;
  if (friction_is_frozen_) {
    old_pairs.swap(list_.pairs);
    old_elements.swap(list_.elements);
  }
  const auto first = static_cast<std::uint32_t>(scene.first_sphere());
  const auto owned = static_cast<std::uint32_t>(scene.owned_spheres());
  const auto spheres = scene.bodies().subspan(first);
  list_.pairs.clear();
  {
    const std::vector<SphereNeighbours> found = surfaces_.layer().take_sphere_neighbours();
    list_.pairs.reserve(found.size());
    for (const SphereNeighbours& n : found) list_.pairs.push_back({n.a - first, (n.b - first) & 0x7FFFFFFFu, 0});
  }
  if (friction_is_frozen_)
    keep_step_friction(scene, std::move(old_pairs), std::move(old_elements));
  else
    list_.elements.assign(list_.pairs.size(), {});
  if (!list_.uniform()) {
    list_.material.resize(spheres.size());
    for (std::size_t i = 0; i < spheres.size(); ++i) list_.material[i] = spheres[i].material;
  }
  list_.set_layout(scene.sphere_point(), owned, threads());

  std::vector<std::uint32_t> known(owned, 0);  // attached pairs of each sphere
  for (SpherePair& pair : list_.pairs) {
    const CellId a = spheres[pair.a].id, b = spheres[pair.b].id;
    if (!(pair.a < owned ? cbm::adheres(tissue.spheres.attached[pair.a], b) : cbm::adheres(tissue.spheres.attached[pair.b], a))) continue;
    pair.attached = 1;
    if (pair.a < owned) ++known[pair.a];
    if (pair.b < owned) ++known[pair.b];
  }
  find_rigid_pairs(scene, tissue);
  for (std::size_t k = 0; k < rigid_.size(); ++k)
    if (k == 0 || !rigid_[k].same_bodies(rigid_[k - 1])) known[rigid_[k].sphere] += rigid_[k].attached;
  partners_are_lost_ = false;
  for (std::uint32_t i = 0; i < owned; ++i) partners_are_lost_ = partners_are_lost_ || known[i] != tissue.spheres.attached[i].size();
  find_sisters(scene, tissue);
}

void SphereContacts::keep_step_friction(const Scene& scene, std::vector<SpherePair> old_pairs,
                                        std::vector<SpherePairElement> old_elements) {
  const auto spheres = scene.bodies().subspan(scene.first_sphere());
  const auto before = [&](const SpherePair& p, const SpherePair& q) {
    return p.a != q.a ? spheres[p.a].place < spheres[q.a].place : spheres[p.b].place < spheres[q.b].place;
  };
  std::vector<SpherePair> merged;
  merged.reserve(list_.pairs.size() + list_.pairs.size() / 64);
  list_.elements.clear();
  list_.elements.reserve(merged.capacity());
  std::size_t k = 0;
  const auto add_parted = [&](auto&& until) {  // pairs that rubbed at the step's start and are out of reach by now go on to the step's end
    for (; k < old_pairs.size() && until(old_pairs[k]); ++k) {
      if (old_elements[k].area == 0.0f) continue;
      merged.push_back({old_pairs[k].a, old_pairs[k].b, 0});
      list_.elements.push_back(old_elements[k]);
    }
  };
  for (const SpherePair& pair : list_.pairs) {
    add_parted([&](const SpherePair& old) { return before(old, pair); });
    merged.push_back(pair);
    const bool same = k < old_pairs.size() && old_pairs[k].a == pair.a && old_pairs[k].b == pair.b;
    list_.elements.push_back(same ? old_elements[k++] : SpherePairElement{});
  }
  add_parted([](const SpherePair&) { return true; });
  list_.pairs = std::move(merged);
}

void SphereContacts::find_rigid_pairs(const Scene& scene, const Tissue& tissue) {
  const std::vector<RigidPair> old = std::move(rigid_);
  const std::vector<RigidPairElement> old_elements = std::move(list_.rigid);
  rigid_.clear();
  list_.rigid.clear();
  const auto obstacles = layer().obstacles();
  const auto spheres = scene.bodies().subspan(scene.first_sphere());
  std::size_t k = 0;
  std::vector<std::uint32_t> faces, parts;
  for (std::uint32_t i = 0; i < scene.owned_spheres(); ++i)
    for (std::uint32_t o = 0; o < obstacles.size(); ++o) {
      const double reach = spheres[i].radius + layer().settings().sphere_reach + layer().settings().body_skin;
      Box box;
      box.include(scene.position()[spheres[i].first_point] - layer().obstacle_offset(o));
      obstacles[o].tree->faces_in(box.inflated(reach), faces);
      parts.clear();
      for (const std::uint32_t face : faces) parts.push_back(obstacles[o].part_of_face[face]);
      for (; k < old.size() && (old[k].sphere != i ? old[k].sphere < i : old[k].obstacle <= o); ++k)  // what rubs goes on to the step's end
        if (friction_is_frozen_ && old[k].sphere == i && old[k].obstacle == o && rubs(old_elements[k])) parts.push_back(old[k].part);
      std::sort(parts.begin(), parts.end());
      parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
      const bool attached = !parts.empty() && cbm::adheres(tissue.spheres.attached[i], obstacle_partner(o));
      for (const std::uint32_t part : parts) {
        RigidPair& pair = rigid_.emplace_back();
        pair.sphere = i;
        pair.obstacle = o;
        pair.part = part;
        pair.attached = pair.attached_next = attached;
        RigidPairElement& element = list_.rigid.emplace_back();
        element.sphere = i;
      }
    }
  if (!friction_is_frozen_) return;
  const auto before = [](const RigidPair& a, const RigidPair& b) {
    return std::tie(a.sphere, a.obstacle, a.part) < std::tie(b.sphere, b.obstacle, b.part);
  };
  for (std::size_t n = 0; n < old.size(); ++n) {
    if (!rubs(old_elements[n])) continue;
    list_.rigid[static_cast<std::size_t>(std::lower_bound(rigid_.begin(), rigid_.end(), old[n], before) - rigid_.begin())] =
        old_elements[n];
  }
}

void SphereContacts::find_sisters(const Scene& scene, const Tissue& tissue) {
  sisters_.clear();
  const auto spheres = scene.bodies().subspan(scene.first_sphere());
  std::vector<Scene::Birth> birth;
  for (std::uint32_t k = 0; k < list_.pairs.size(); ++k) {
    const SpherePair pair = list_.pairs[k];
    if (!cbm::are_sisters(spheres[pair.a].id, spheres[pair.b].id)) continue;
    if (birth.empty()) birth = scene.sphere_births(tissue);
    sisters_.push_back({k, birth[pair.a].radius, birth[pair.b].radius, birth[pair.a].time, 0.0});
  }
  update_sisters(scene, tissue.clock.time);
}

void SphereContacts::write_partners(const Scene& scene, const std::vector<char>& marked, Tissue& tissue) const {
  const std::size_t owned = scene.owned_spheres();
  const cbm::PartnerLists& old = tissue.spheres.attached;
  std::vector<std::uint32_t> end(owned, 0);
  const auto for_attached = [&](auto&& function) {
    for (const SpherePair& pair : list_.pairs) {
      if (!pair.attached) continue;
      if (pair.a < owned && marked[pair.a]) function(pair.a, partner_id(scene, pair.b));
      if (pair.b < owned && marked[pair.b]) function(pair.b, partner_id(scene, pair.a));
    }
    for (std::size_t k = 0; k < rigid_.size(); ++k)
      if (rigid_[k].attached && marked[rigid_[k].sphere] && (k == 0 || !rigid_[k].same_bodies(rigid_[k - 1])))
        function(rigid_[k].sphere, obstacle_partner(rigid_[k].obstacle));
  };
  for_attached([&](std::uint32_t i, CellId) { ++end[i]; });
  std::uint32_t total = 0;
  for (std::size_t i = 0; i < owned; ++i) {  // end[i] is where the list of i begins until its ids are copied
    const std::uint32_t count = marked[i] ? end[i] : static_cast<std::uint32_t>(old[i].size());
    end[i] = total;
    total += count;
  }
  std::vector<CellId> ids(total);
  for (std::size_t i = 0; i < owned; ++i) {
    if (marked[i]) continue;
    std::copy(old[i].begin(), old[i].end(), ids.begin() + end[i]);
    end[i] += static_cast<std::uint32_t>(old[i].size());
  }
  for_attached([&](std::uint32_t i, CellId partner) { ids[end[i]++] = partner; });
  for (std::size_t i = 0; i < owned; ++i)
    if (marked[i]) std::sort(ids.begin() + (i == 0 ? 0 : end[i - 1]), ids.begin() + end[i]);
  tissue.spheres.attached = cbm::PartnerLists(std::move(ids), std::move(end));
}

}  // namespace morula
