/// Who touches whom: how many contacts cells are away from others, where their neighbours lie, and which are at the tissue's surface.
#include <algorithm>
#include <numeric>

#include "core/parallel/threads.h"
#include "coupling/mechanics/mechanics.h"
#include "coupling/mechanics/workspace.h"

namespace morula {
namespace {

using TwoBodies = std::pair<std::uint32_t, std::uint32_t>;

/// The pairs of bodies that touch, as this rank sees them.
std::vector<TwoBodies> touching_bodies(const Workspace& work) {
  const Scene& scene = work.scene;
  const Space& space = work.setting.model.space;
  std::vector<TwoBodies> out;
  for (const SurfacePair& pair : work.terms.contacts->layer().pairs())
    if (!pair.rigid && !pair.with_itself() && pair.area > 0.0) out.emplace_back(pair.a, pair.b);
  const auto first = static_cast<std::uint32_t>(scene.first_sphere());
  const auto bodies = scene.bodies();
  for (const SpherePair& pair : work.terms.spheres->pairs().pairs) {
    const std::uint32_t a = first + pair.a, b = first + pair.b;
    const double radii = bodies[a].radius + bodies[b].radius;
    const Vec3d between = space.nearest_image(scene.position()[bodies[b].first_point] - scene.position()[bodies[a].first_point]);
    if (pair.attached || norm2(between) < radii * radii) out.emplace_back(a, b);
  }
  return out;
}

/// Number in the scene of an owned body, by its place among shells, then spheres.
std::size_t body_of_place(const Scene& scene, std::size_t place) {
  return place < scene.owned_shells() ? place : scene.first_sphere() + (place - scene.owned_shells());
}

/// Mean of a body's points.
Vec3d middle(const Scene& scene, const ContactBody& body) {
  Vec3d sum{};
  for (const Vec3d& x : std::span(scene.position()).subspan(body.first_point, body.point_count)) sum += x;
  return sum * (1.0 / body.point_count);
}

}  // namespace

std::vector<std::uint32_t> Mechanics::contact_steps(const Tissue& tissue, std::span<const std::uint32_t> start, std::uint32_t most) {
  (void)prepare(*work_, tissue);
  const Scene& scene = work_->scene;
  const Comm& comm = work_->setting.comm;
  std::vector<std::uint64_t> steps(scene.bodies().size(), kFarAway);
  for (std::size_t i = 0; i < start.size(); ++i) steps[body_of_place(scene, i)] = start[i];
  const std::vector<TwoBodies> touching = touching_bodies(*work_);
  bool goes_on = true;
  for (std::uint64_t k = 1; k <= most && goes_on; ++k) {
    scene.exchange_bodies(steps);
    const bool begins_here = std::ranges::any_of(start, [k](std::uint32_t s) { return s >= k && s != kFarAway; });
    bool found = false;
    for (const auto& [a, b] : touching)
      for (const auto& [from, to] : {TwoBodies{a, b}, TwoBodies{b, a}})
        if (steps[from] == k - 1 && steps[to] > k) steps[to] = k, found = true;
    goes_on = comm.any(found || begins_here);
  }
  std::vector<std::uint32_t> out(start.size());
  for (std::size_t i = 0; i < start.size(); ++i) out[i] = static_cast<std::uint32_t>(steps[body_of_place(scene, i)]);
  return out;
}

namespace {

/// Some owned bodies and all that touch them, by increasing id.
struct Neighbours {
  std::vector<std::vector<std::uint32_t>> body;  ///< of the scene
  std::vector<std::vector<Vec3d>> way;           ///< from middle to middle [µm]
};

Neighbours find_neighbours(const Workspace& work, std::span<const std::size_t> places) {
  const Scene& scene = work.scene;
  const auto bodies = scene.bodies();
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> asked(bodies.size(), kNone);
  for (std::size_t k = 0; k < places.size(); ++k) asked[body_of_place(scene, places[k])] = static_cast<std::uint32_t>(k);
  Neighbours out;
  out.body.resize(places.size());
  out.way.resize(places.size());
  for (const auto& [a, b] : touching_bodies(work)) {
    if (asked[a] != kNone) out.body[asked[a]].push_back(b);
    if (asked[b] != kNone) out.body[asked[b]].push_back(a);
  }
  parallel_for(work.setting.threads, places.size(), [&](std::size_t k) {
    const auto id_of = [&](std::uint32_t b) { return bodies[b].id; };
    std::ranges::sort(out.body[k], {}, id_of);
    const auto twice = std::ranges::unique(out.body[k], {}, id_of);  // images of periodic neighbours
    out.body[k].erase(twice.begin(), twice.end());
    const Vec3d here = middle(scene, bodies[body_of_place(scene, places[k])]);
    for (const std::uint32_t b : out.body[k]) out.way[k].push_back(work.setting.model.space.nearest_image(middle(scene, bodies[b]) - here));
  });
  return out;
}

}  // namespace

std::vector<std::vector<Vec3d>> Mechanics::neighbours_of(const Tissue& tissue, std::span<const std::size_t> places) {
  (void)prepare(*work_, tissue);
  return find_neighbours(*work_, places).way;
}

std::vector<OpenSides> Mechanics::open_sides(const Tissue& tissue) {
  (void)prepare(*work_, tissue);
  const Scene& scene = work_->scene;
  const int threads = work_->setting.threads;
  std::vector<std::size_t> all(tissue.shells.size() + tissue.spheres.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const Neighbours near = find_neighbours(*work_, all);
  std::vector<OpenSides> of_body(scene.bodies().size());
  parallel_for(threads, all.size(), [&](std::size_t i) { of_body[body_of_place(scene, i)] = OpenSides(near.way[i]); });
  std::vector<std::uint64_t> words(of_body.size());
  for (std::size_t w = 0; w < OpenSides::kWords; ++w) {
    for (std::size_t b = 0; b < words.size(); ++b) words[b] = of_body[b].words[w];
    scene.exchange_bodies(words);
    for (std::size_t b = 0; b < words.size(); ++b) of_body[b].words[w] = words[b];
  }
  std::vector<OpenSides> out(all.size());
  parallel_for(threads, all.size(), [&](std::size_t i) {
    std::vector<OpenSides> of_neighbours;
    for (const std::uint32_t b : near.body[i]) of_neighbours.push_back(of_body[b]);
    out[i] = of_body[body_of_place(scene, i)].outward(near.way[i], of_neighbours);
  });
  return out;
}

}  // namespace morula
