// Pairs of young sisters, whose rest distance grows from that of a mother cut in two to that of any pair (cbm.md §5).
#include <algorithm>
#include <vector>

#include "cbm/division_ramp.h"
#include "coupling/mechanics/own_contacts.h"
#include "coupling/mechanics/sphere_contacts.h"

namespace morula {
namespace {

/// Whether sisters that were born then are an ordinary pair, whatever comes of the step that is under way.
bool have_parted(double birth_time, const World& world) { return cbm::sisters_have_parted(birth_time, world.tissue.clock.time); }

}  // namespace

bool SphereContacts::sisters_in(const Scene& scene, const SpherePair& pair) const {
  return cbm::are_sisters(partner_id(scene, pair.a), partner_id(scene, pair.b));
}

void SphereContacts::find_sisters(const World& world) {
  const Scene& scene = world.scene;
  sisters_.clear();
  std::vector<Scene::Birth> birth;
  for (std::uint32_t k = 0; k < list_.pairs.size(); ++k) {
    const SpherePair pair = list_.pairs[k];
    if (!sisters_in(scene, pair)) continue;
    if (birth.empty()) birth = scene.sphere_births(world.tissue);
    if (have_parted(birth[pair.a].time, world)) continue;
    sisters_.push_back({k, birth[pair.a].radius, birth[pair.b].radius, birth[pair.a].time, 0.0});
  }
  update_sisters(scene, world.time);
}

void SphereContacts::add_sisters(const World& world, std::span<const std::uint32_t> of_young) {
  const Scene& scene = world.scene;
  std::vector<std::uint32_t> pairs, spheres;
  for (const std::uint32_t k : of_young)
    if (sisters_in(scene, list_.pairs[k])) pairs.push_back(k);
  std::erase_if(sisters_, [&](const Sisters& s) { return have_parted(s.birth_time, world) || std::ranges::binary_search(pairs, s.pair); });
  for (const std::uint32_t k : pairs) spheres.insert(spheres.end(), {list_.pairs[k].a, list_.pairs[k].b});
  std::ranges::sort(spheres);
  spheres.erase(std::ranges::unique(spheres).begin(), spheres.end());
  const std::vector<Scene::Birth> births = scene.sphere_births(world.tissue, spheres);
  const auto birth = [&](std::uint32_t sphere) {
    return births[static_cast<std::size_t>(std::ranges::lower_bound(spheres, sphere) - spheres.begin())];
  };
  for (const std::uint32_t k : pairs) {
    const Scene::Birth a = birth(list_.pairs[k].a), b = birth(list_.pairs[k].b);
    if (!have_parted(a.time, world)) sisters_.push_back({k, a.radius, b.radius, a.time, 0.0});
  }
  std::ranges::sort(sisters_, {}, &Sisters::pair);
  update_sisters(scene, world.time);
}

void SphereContacts::update_sisters(const Scene& scene, double now) {
  const std::size_t first = scene.first_sphere();
  OwnContacts own(model_, table_, layer().own_factors());
  for (Sisters& s : sisters_) {
    const std::size_t number_a = first + list_.pairs[s.pair].a, number_b = first + list_.pairs[s.pair].b;
    const ContactBody &a = scene.bodies()[number_a], &b = scene.bodies()[number_b];
    const cbm::PairContact contact = own.vary() ? own.of(a, number_a, b, number_b) : table_.entry(a.material, b.material).contact;
    const double rest =
        contact.law->rest_overlap != nullptr ? contact.law->rest_overlap(contact, cbm::reduced_radius(a.radius, b.radius)) : 0.0;
    s.offset = cbm::sister_overlap_offset(rest, a.radius, b.radius, s.birth_radius_a, s.birth_radius_b, now - s.birth_time);
  }
}

SphereContacts::Renewed SphereContacts::renew_sisters(const World& world) {
  if (sisters_.empty()) return Renewed::kNothing;
  const Scene& scene = world.scene;
  const std::vector<Sisters> before = sisters_;
  update_sisters(scene, world.tissue.clock.time);
  std::vector<char> marked;
  for (std::size_t s = 0; s < sisters_.size(); ++s) {
    if (sisters_[s].offset == before[s].offset) continue;
    const SpherePair& pair = list_.pairs[sisters_[s].pair];
    for (const std::uint32_t i : {pair.a, std::uint32_t{pair.b}}) mark(marked, scene, i);
  }
  if (marked.empty()) return Renewed::kNothing;
  refresh_values(scene, marked);
  return Renewed::kPacking;
}

}  // namespace morula
