/// The lists of SphereContacts after a few bodies have come or gone.
#include <algorithm>
#include <cassert>

#include "core/parallel/threads.h"
#include "coupling/mechanics/sphere_contacts.h"

namespace morula {

void SphereContacts::bodies_replaced(const World& world, const BodyChanges& changes) {
  if (layer().is_stale() || list_number_ != surfaces_.list_number()) {
    sisters_.clear();  // the list is to be made anew
    young_.clear();
    return;
  }
  assert(!friction_is_frozen_);
  const Scene& scene = world.scene;
  const auto first = static_cast<std::uint32_t>(scene.first_sphere());
  const auto now = [&](std::uint32_t sphere) {
    const std::uint32_t body = changes.now[changes.shells_before + sphere];
    return body == BodyChanges::kNone ? body : body - first;
  };
  std::vector<std::uint32_t> place(changes.before.size() -
                                   changes.shells_before);  // by old number: the new one, whether or not its pairs stay
  for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = now(i);
  for (const auto& [before, body] : changes.strays) place[before - changes.shells_before] = body - first;
  std::vector<char> fresh(scene.bodies().size() - first, 0), born;  // whose pairs are new; of them those that were not there
  for (const std::uint32_t body : changes.fresh)
    if (body >= first) fresh[body - first] = 1;
  born = fresh;
  for (const auto& [before, body] : changes.strays) born[body - first] = 0;
  for (const std::uint32_t sphere : young_)
    if (const std::uint32_t there = place[sphere]; there != BodyChanges::kNone) fresh[there] = born[there] = 1;
  young_.clear();
  for (std::uint32_t i = 0; i < born.size(); ++i)
    if (born[i]) young_.push_back(i);

  std::vector<char> suspects = born;  // whose partners may be others
  for (const std::uint32_t sphere : lost_)
    if (const std::uint32_t there = place[sphere]; there != BodyChanges::kNone) suspects[there] = 1;
  renumber_pairs(now, place, suspects);
  add_pairs(scene, surfaces_.layer().take_sphere_neighbours());
  list_.elements.resize(list_.pairs.size());
  if (!list_.uniform()) {
    list_.material.resize(fresh.size());
    for (std::size_t i = 0; i < fresh.size(); ++i) list_.material[i] = scene.bodies()[first + i].material;
  }
  list_.set_layout(scene.sphere_point(), static_cast<std::uint32_t>(scene.owned_spheres()), threads());
  const auto of_fresh = gather<std::uint32_t>(threads(), list_.pairs.size(), [&](std::size_t k, std::vector<std::uint32_t>& out) {
    if (const SpherePair pair = list_.pairs[k]; (fresh[pair.a] | fresh[pair.b]) != 0) out.push_back(static_cast<std::uint32_t>(k));
  });
  for (const std::uint32_t k : of_fresh) {
    SpherePair& pair = list_.pairs[k];
    pair.attached = are_attached(scene, world.tissue, pair);
    if (born[pair.a] | born[pair.b]) suspects[pair.a] = suspects[pair.b] = 1;
  }
  renumber_rigid_pairs(scene, world.tissue, now, fresh);
  for (auto& flips : flips_) flips.clear();
  look_for_lost(scene, world.tissue, std::move(suspects));
  add_sisters(world, of_fresh);
}

template <class Now>
void SphereContacts::renumber_pairs(const Now& now, std::span<const std::uint32_t> place, std::vector<char>& suspects) {
  std::uint32_t kept = 0;
  auto sisters = sisters_.begin(), kept_sisters = sisters_.begin();
  for (std::uint32_t k = 0; k < list_.pairs.size(); ++k) {
    SpherePair pair = list_.pairs[k];
    const bool has_sisters = sisters != sisters_.end() && sisters->pair == k;
    const std::uint32_t a = now(pair.a), b = now(pair.b);
    if (a != BodyChanges::kNone && b != BodyChanges::kNone) {
      pair.a = a;
      pair.b = b & 0x7FFFFFFFu;
      if (has_sisters) *kept_sisters = *sisters, (kept_sisters++)->pair = kept;
      list_.pairs[kept++] = pair;
    } else if (const bool has_a = place[pair.a] != BodyChanges::kNone; has_a != (place[pair.b] != BodyChanges::kNone)) {
      suspects[place[has_a ? pair.a : std::uint32_t{pair.b}]] = 1;
    }
    if (has_sisters) ++sisters;
  }
  list_.pairs.resize(kept);
  sisters_.erase(kept_sisters, sisters_.end());
}

void SphereContacts::add_pairs(const Scene& scene, const std::vector<SphereNeighbours>& found) {
  const auto bodies = scene.bodies();
  const auto first = static_cast<std::uint32_t>(scene.first_sphere());
  const auto before = [&](const SphereNeighbours& p, const SpherePair& q) {
    const std::uint32_t place = bodies[first + q.a].place;
    return bodies[p.a].place != place ? bodies[p.a].place < place : bodies[p.b].place < bodies[first + q.b].place;
  };
  std::size_t kept = list_.pairs.size(), to = kept + found.size();
  auto sisters = sisters_.end();
  list_.pairs.resize(to);
  for (std::size_t n = found.size(); n > 0;) {  // from the end: what comes later makes room
    if (kept > 0 && before(found[n - 1], list_.pairs[kept - 1])) {
      list_.pairs[--to] = list_.pairs[--kept];
      if (sisters != sisters_.begin() && std::prev(sisters)->pair == kept) (--sisters)->pair = static_cast<std::uint32_t>(to);
    } else {
      --n;
      list_.pairs[--to] = {found[n].a - first, (found[n].b - first) & 0x7FFFFFFFu, 0};
    }
  }
}

template <class Now>
void SphereContacts::renumber_rigid_pairs(const Scene& scene, const Tissue& tissue, const Now& now, const std::vector<char>& fresh) {
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
    pair.sphere = now(pair.sphere);
    if (pair.sphere == BodyChanges::kNone || fresh[pair.sphere]) continue;
    add_fresh(pair.sphere);
    rigid_.push_back(pair);
    list_.rigid.emplace_back().sphere = pair.sphere;
  }
  add_fresh(fresh.size());
}

void SphereContacts::look_for_lost(const Scene& scene, const Tissue& tissue, std::vector<char> suspects) {
  lost_.clear();
  // A shell that became a sphere is a partner of all that it touched, whether or not the sphere reaches them.
  const std::vector<std::uint32_t> known = attached_pairs(scene);
  for (std::uint32_t i = 0; i < known.size(); ++i)
    if (known[i] != tissue.spheres.attached[i].size()) suspects[i] = 1;
  const std::vector<std::pair<std::uint32_t, CellId>> found = partners_of(scene, suspects);
  auto at = found.begin();
  for (std::uint32_t i = 0; i < scene.owned_spheres(); ++i) {
    if (!suspects[i]) continue;
    bool same = true;
    std::size_t count = 0;
    const std::span<const CellId> listed = tissue.spheres.attached[i];
    for (; at != found.end() && at->first == i; ++at, ++count) same = same && count < listed.size() && listed[count] == at->second;
    if (!same || count != listed.size()) lost_.push_back(i);
  }
}

}  // namespace morula
