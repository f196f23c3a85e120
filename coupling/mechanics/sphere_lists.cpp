/// The lists of SphereContacts: which pairs there are, and who adheres to whom.
#include <algorithm>
#include <atomic>
#include <tuple>

#include "core/parallel/threads.h"
#include "coupling/mechanics/merge_sphere_pairs.h"
#include "coupling/mechanics/sphere_contacts.h"

namespace morula {
namespace {

bool rubs(const RigidPairElement& element) { return element.isotropic != 0.0f || element.axial != 0.0f; }

}  // namespace

CellId SphereContacts::partner_id(const Scene& scene, std::uint32_t sphere) const {
  return scene.bodies()[scene.first_sphere() + sphere].id;
}

void SphereContacts::set_pairs(const World& world) {
  const Scene& scene = world.scene;
  const Tissue& tissue = world.tissue;
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
    for (const SphereNeighbours& n : found) list_.pairs.push_back(pair_of(n, first));
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

  parallel_for(threads(), list_.pairs.size(), [&](std::size_t k) {
    SpherePair& pair = list_.pairs[k];
    pair.attached = are_attached(scene, tissue, pair);
  });
  find_rigid_pairs(scene, tissue);
  count_partners(scene, tissue);
  find_sisters(world);
}

bool SphereContacts::are_attached(const Scene& scene, const Tissue& tissue, const SpherePair& pair) const {
  const std::uint32_t owned_one = pair.a < scene.owned_spheres() ? pair.a : pair.b;
  return cbm::adheres(tissue.spheres.attached[owned_one], partner_id(scene, owned_one == pair.a ? pair.b : pair.a));
}

std::vector<std::uint32_t> SphereContacts::listed_partners() const {
  std::vector<std::uint32_t> out = adhesion_.count;
  for (std::size_t k = 0; k < rigid_.size(); ++k)
    if (k == 0 || !rigid_[k].same_bodies(rigid_[k - 1])) out[rigid_[k].sphere] += rigid_[k].attached;
  return out;
}

void SphereContacts::count_partners(const Scene& scene, const Tissue& tissue) {
  adhesion_.count.assign(scene.bodies().size() - scene.first_sphere(), 0);
  parallel_for(threads(), list_.pairs.size(), [&](std::size_t k) {
    if (const SpherePair& pair = list_.pairs[k]; pair.attached)
      for (const std::uint32_t i : {pair.a, std::uint32_t{pair.b}})
        std::atomic_ref(adhesion_.count[i]).fetch_add(1, std::memory_order_relaxed);
  });
  const std::vector<std::uint32_t> known = listed_partners();
  adhesion_.partners_are_lost = false;
  adhesion_.lost.clear();
  for (std::uint32_t i = 0; i < scene.owned_spheres(); ++i)
    adhesion_.partners_are_lost = adhesion_.partners_are_lost || known[i] != tissue.spheres.attached[i].size();
}

void SphereContacts::keep_step_friction(const Scene& scene, std::vector<SpherePair> old_pairs,
                                        std::vector<SpherePairElement> old_elements) {
  const auto spheres = scene.bodies().subspan(scene.first_sphere());
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
    add_parted([&](const SpherePair& old) { return comes_before(spheres, old, pair); });
    merged.push_back(pair);
    const bool same = k < old_pairs.size() && old_pairs[k].a == pair.a && old_pairs[k].b == pair.b;
    list_.elements.push_back(same ? old_elements[k++] : SpherePairElement{});
  }
  add_parted([](const SpherePair&) { return true; });
  list_.pairs = std::move(merged);
}

void SphereContacts::add_rigid_pairs(const Scene& scene, const Tissue& tissue, std::uint32_t sphere, std::span<const RigidPair> rubs) {
  const auto obstacles = layer().obstacles();
  const ContactBody& body = scene.bodies()[scene.first_sphere() + sphere];
  const double reach = body.radius + layer().settings().sphere_reach + layer().settings().body_skin;
  const Vec3d center = scene.position()[body.first_point];
  std::vector<std::uint32_t> parts;
  const auto add = [&](std::uint32_t o, const SurfaceImage& image) {
    const Vec3d from = center - (layer().obstacle_offset(o) + image.shift);
    parts_near(obstacles[o], from, reach, parts);
    for (const RigidPair& pair : rubs)
      if (pair.obstacle == o && pair.image.number == image.number && !std::ranges::binary_search(parts, pair.part))
        parts.insert(std::ranges::upper_bound(parts, pair.part), pair.part);
    const bool attached = !parts.empty() && cbm::adheres(tissue.spheres.attached[sphere], obstacle_partner(o));
    for (const std::uint32_t part : parts) {
      RigidPair& pair = rigid_.emplace_back();
      pair.sphere = sphere;
      pair.obstacle = o;
      pair.part = part;
      pair.image = image;
      pair.attached = pair.attached_next = attached;
      list_.rigid.push_back({sphere, o});
    }
  };
  const Box around = Box{center, center}.inflated(2.0 * reach);  // further than what rubbed at the step's start has gone since
  for (std::uint32_t o = 0; o < obstacles.size(); ++o)
    for_images(obstacles[o], layer().obstacle_offset(o), model_.space, around, [&](const SurfaceImage& image) { add(o, image); });
}

void SphereContacts::find_rigid_pairs(const Scene& scene, const Tissue& tissue) {
  const std::vector<RigidPair> old = std::move(rigid_);
  const std::vector<RigidPairElement> old_elements = std::move(list_.rigid);
  rigid_.clear();
  list_.rigid.clear();
  if (layer().obstacles().empty()) return;
  std::vector<RigidPair> go_on;
  for (std::size_t n = 0; n < old.size() && friction_is_frozen_; ++n)
    if (rubs(old_elements[n])) go_on.push_back(old[n]);
  std::size_t k = 0;
  for (std::uint32_t i = 0; i < scene.owned_spheres(); ++i) {
    const std::size_t from = k;
    while (k < go_on.size() && go_on[k].sphere == i) ++k;
    add_rigid_pairs(scene, tissue, i, std::span(go_on).subspan(from, k - from));
  }
  if (!friction_is_frozen_) return;
  const auto before = [](const RigidPair& a, const RigidPair& b) {
    return std::tie(a.sphere, a.obstacle, a.image.number, a.part) < std::tie(b.sphere, b.obstacle, b.image.number, b.part);
  };
  for (std::size_t n = 0; n < old.size(); ++n) {
    const auto now = std::lower_bound(rigid_.begin(), rigid_.end(), old[n], before);
    if (now == rigid_.end() || before(old[n], *now)) continue;
    now->support = old[n].support;
    if (rubs(old_elements[n])) list_.rigid[static_cast<std::size_t>(now - rigid_.begin())] = old_elements[n];
  }
}

void SphereContacts::write_partners(const Scene& scene, const std::vector<char>& marked, Tissue& tissue) const {
  const std::vector<std::pair<std::uint32_t, CellId>> found = partners_of(scene, marked);
  std::vector<CellId> partners;
  auto at = found.begin();
  for (std::uint32_t i = 0; i < scene.owned_spheres(); ++i) {
    if (!marked[i]) continue;
    partners.clear();
    for (; at != found.end() && at->first == i; ++at) partners.push_back(at->second);
    tissue.spheres.attached.set(i, partners);
  }
}

std::vector<std::pair<std::uint32_t, CellId>> SphereContacts::partners_of(const Scene& scene, const std::vector<char>& marked) const {
  using Partner = std::pair<std::uint32_t, CellId>;
  const auto owned = static_cast<std::uint32_t>(scene.owned_spheres());
  std::vector<std::uint64_t> bits(marked.size() / 64 + 1, 0);  // all pairs ask, and few spheres are marked
  for (std::size_t i = 0; i < marked.size(); ++i) bits[i / 64] |= std::uint64_t{marked[i] != 0} << (i % 64);
  const auto is_marked = [&](std::uint32_t i) { return bits[i / 64] >> (i % 64) & 1; };
  std::vector<Partner> out = gather<Partner>(threads(), list_.pairs.size(), [&](std::size_t k, std::vector<Partner>& to) {
    const SpherePair& pair = list_.pairs[k];
    if ((pair.attached & (is_marked(pair.a) | is_marked(pair.b))) == 0) return;
    if (pair.a < owned && marked[pair.a]) to.emplace_back(pair.a, partner_id(scene, pair.b));
    if (pair.b < owned && marked[pair.b]) to.emplace_back(pair.b, partner_id(scene, pair.a));
  });
  for (std::size_t k = 0; k < rigid_.size(); ++k)
    if (rigid_[k].attached && marked[rigid_[k].sphere] && (k == 0 || !rigid_[k].same_bodies(rigid_[k - 1])))
      out.emplace_back(rigid_[k].sphere, obstacle_partner(rigid_[k].obstacle));
  std::ranges::sort(out);
  return out;
}

}  // namespace morula
