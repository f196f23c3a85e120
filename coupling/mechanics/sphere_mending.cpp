/// The lists of SphereContacts after a few bodies have come or gone.
#include <algorithm>
#include <cassert>

#include "coupling/mechanics/merge_sphere_pairs.h"
#include "coupling/mechanics/sphere_contacts.h"

namespace morula {

void SphereContacts::bodies_replaced(const World& world, const BodyChanges& changes) {
  if (layer().is_stale() || list_number_ != surfaces_.list_number()) {
    sisters_.clear();  // the list is to be made anew
    adhesion_.young.clear();
    return;
  }
  assert(!friction_is_frozen_);
  const Scene& scene = world.scene;
  const auto first = static_cast<std::uint32_t>(scene.first_sphere());
  SphereRenumbering number;
  number.now.resize(changes.before.size() - changes.shells_before);
  for (std::uint32_t i = 0; i < number.now.size(); ++i) {
    const std::uint32_t body = changes.now[changes.shells_before + i];
    number.now[i] = body == BodyChanges::kNone ? body : body - first;
  }
  number.place = number.now;
  for (const auto& [before, body] : changes.strays) number.place[before - changes.shells_before] = body - first;
  std::vector<char> fresh(scene.bodies().size() - first, 0), born;  // whose pairs are new; of them those that were not there
  for (const std::uint32_t body : changes.fresh)
    if (body >= first) fresh[body - first] = 1;
  born = fresh;
  for (const auto& [before, body] : changes.strays) born[body - first] = 0;
  for (const std::uint32_t sphere : adhesion_.young)
    if (const std::uint32_t there = number.place[sphere]; there != BodyChanges::kNone) fresh[there] = born[there] = 1;
  adhesion_.young.clear();
  for (std::uint32_t i = 0; i < born.size(); ++i)
    if (born[i]) adhesion_.young.push_back(i);

  std::vector<char> suspects = born;  // whose partners may be others
  for (const std::uint32_t sphere : adhesion_.lost)
    if (const std::uint32_t there = number.place[sphere]; there != BodyChanges::kNone) suspects[there] = 1;
  const std::vector<std::uint32_t> of_fresh = merge_pairs(scene, number, fresh, suspects);
  list_.elements.resize(list_.pairs.size());
  if (!list_.uniform()) {
    list_.material.resize(fresh.size());
    for (std::size_t i = 0; i < fresh.size(); ++i) list_.material[i] = scene.bodies()[first + i].material;
  }
  list_.set_layout(scene.sphere_point(), static_cast<std::uint32_t>(scene.owned_spheres()), threads());
  for (const std::uint32_t k : of_fresh) {
    SpherePair& pair = list_.pairs[k];
    set_attached(pair, are_attached(scene, world.tissue, pair));
    if (born[pair.a] | born[pair.b]) suspects[pair.a] = suspects[pair.b] = 1;
  }
  renumber_rigid_pairs(scene, world.tissue, number.now, fresh);
  for (auto& flips : adhesion_.flips) flips.clear();
  look_for_lost(scene, world.tissue, std::move(suspects));
  add_sisters(world, of_fresh);
}

std::vector<std::uint32_t> SphereContacts::merge_pairs(const Scene& scene, const SphereRenumbering& number, std::span<const char> fresh,
                                                       std::vector<char>& suspects) {
  std::vector<std::uint32_t> of_sisters;
  for (const Sisters& s : sisters_) of_sisters.push_back(s.pair);
  const auto first = static_cast<std::uint32_t>(scene.first_sphere());
  MergedPairs merged = merge_sphere_pairs(list_.pairs, number, surfaces_.layer().take_sphere_neighbours(), scene.bodies().subspan(first),
                                          first, fresh, of_sisters, threads());

  std::vector<std::uint32_t> adhering(fresh.size(), 0);
  for (std::size_t i = 0; i < number.place.size(); ++i)
    if (number.place[i] != BodyChanges::kNone) adhering[number.place[i]] = adhesion_.count[i];
  for (const SpherePair& pair : merged.dropped) {
    const std::uint32_t a = number.place[pair.a], b = number.place[pair.b];
    for (const std::uint32_t there : {a, b})
      if (there != BodyChanges::kNone) adhering[there] -= pair.attached;
    if ((a == BodyChanges::kNone) != (b == BodyChanges::kNone)) suspects[a != BodyChanges::kNone ? a : b] = 1;
  }
  adhesion_.count = std::move(adhering);

  for (std::size_t s = 0; s < sisters_.size(); ++s) sisters_[s].pair = merged.watched[s];
  std::erase_if(sisters_, [](const Sisters& s) { return s.pair == MergedPairs::kGone; });
  return std::move(merged.of_fresh);
}

void SphereContacts::set_attached(SpherePair& pair, bool attached) {
  if (attached == (pair.attached != 0)) return;
  pair.attached = attached;
  for (const std::uint32_t i : {pair.a, std::uint32_t{pair.b}}) attached ? ++adhesion_.count[i] : --adhesion_.count[i];
}

void SphereContacts::renumber_rigid_pairs(const Scene& scene, const Tissue& tissue, std::span<const std::uint32_t> now,
                                          std::span<const char> fresh) {
  if (layer().obstacles().empty()) return;
  const std::vector<RigidPair> old = std::move(rigid_);
  rigid_.clear();
  list_.rigid.clear();
  std::uint32_t next = 0;
  const auto add_fresh = [&](std::size_t until) {
    for (; next < until; ++next)
      if (fresh[next] && next < scene.owned_spheres()) add_rigid_pairs(scene, tissue, next, {});
  };
  for (RigidPair pair : old) {
    pair.sphere = now[pair.sphere];
    if (pair.sphere == BodyChanges::kNone || fresh[pair.sphere]) continue;
    add_fresh(pair.sphere);
    rigid_.push_back(pair);
    list_.rigid.push_back({pair.sphere, pair.obstacle});
  }
  add_fresh(fresh.size());
}

void SphereContacts::look_for_lost(const Scene& scene, const Tissue& tissue, std::vector<char> suspects) {
  adhesion_.lost.clear();
  // A shell that became a sphere is a partner of all that it touched, whether or not the sphere reaches them.
  const std::vector<std::uint32_t> known = listed_partners();
  for (std::uint32_t i = 0; i < scene.owned_spheres(); ++i)
    if (known[i] != tissue.spheres.attached[i].size()) suspects[i] = 1;
  const std::vector<std::pair<std::uint32_t, CellId>> found = partners_of(scene, suspects);
  auto at = found.begin();
  for (std::uint32_t i = 0; i < scene.owned_spheres(); ++i) {
    if (!suspects[i]) continue;
    bool same = true;
    std::size_t count = 0;
    const std::span<const CellId> listed = tissue.spheres.attached[i];
    for (; at != found.end() && at->first == i; ++at, ++count) same = same && count < listed.size() && listed[count] == at->second;
    if (!same || count != listed.size()) adhesion_.lost.push_back(i);
  }
}

}  // namespace morula
