/// How many contacts away cells are from others.
#include <algorithm>

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

}  // namespace

std::vector<std::uint32_t> Mechanics::contact_steps(const Tissue& tissue, std::span<const std::uint32_t> start, std::uint32_t most) {
  (void)prepare(*work_, tissue);
  const Scene& scene = work_->scene;
  const Comm& comm = work_->setting.comm;
  const std::size_t shells = scene.owned_shells();
  const auto body_of = [&](std::size_t place) { return place < shells ? place : scene.first_sphere() + (place - shells); };
  std::vector<std::uint64_t> steps(scene.bodies().size(), kFarAway);
  for (std::size_t i = 0; i < start.size(); ++i) steps[body_of(i)] = start[i];
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
  for (std::size_t i = 0; i < start.size(); ++i) out[i] = static_cast<std::uint32_t>(steps[body_of(i)]);
  return out;
}

}  // namespace morula
