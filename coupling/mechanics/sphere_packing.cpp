/// Packing of the spheres: how much of each is taken by its neighbours, and the pressure that answers (cbm.md §3).
#include <algorithm>
#include <cmath>

#include "core/ball.h"
#include "core/parallel/threads.h"
#include "coupling/mechanics/sphere_contacts.h"

namespace morula {

void SphereContacts::find_packing(const Scene& scene, std::span<const Penetration> penetration, const Comm& comm) {
  const auto owned = static_cast<std::uint32_t>(scene.owned_spheres());
  const Vec3d* x = scene.position().data() + scene.sphere_point();
  const ContactBody* body = scene.bodies().data() + scene.first_sphere();
  const bool periodic = model_.space.any_periodic();
  std::vector<double> taken(owned, 0.0), slopes(owned, 0.0);
  const auto shares = list_.shares();
  on_each_thread(threads(), [&](std::size_t t) {
    const SpherePairs::Share& share = shares[t];
    for (const SpherePairs::Run& run : share.runs) {
      auto sisters =
          std::lower_bound(sisters_.begin(), sisters_.end(), run.first, [](const Sisters& s, std::uint32_t k) { return s.pair < k; });
      for (std::uint32_t k = run.first; k < run.last; ++k) {
        const SpherePair pair = list_.pairs[k];
        double offset = 0.0;
        if (sisters != sisters_.end() && sisters->pair == k) offset = (sisters++)->offset;
        Vec3d between = x[pair.b] - x[pair.a];
        if (periodic) between = model_.space.nearest_image(between);
        const double a = body[pair.a].radius, b = body[pair.b].radius;
        if (norm2(between) >= (a + b) * (a + b)) continue;
        const cbm::SphereCaps caps = cbm::sphere_caps(a, b, norm(between) + offset);
        if (share.has(pair.a)) {
          taken[pair.a] += caps.volume_a;
          slopes[pair.a] += caps.slope_a;
        }
        if (share.has(pair.b)) {
          taken[pair.b] += caps.volume_b;
          slopes[pair.b] += caps.slope_b;
        }
      }
    }
  });
  std::vector<Penetration> others(owned);  // surfaces and walls
  for (std::uint32_t i = 0; i < owned && !penetration.empty(); ++i) others[i] = penetration[scene.first_sphere() + i];
  for (RigidPair& pair : rigid_) {
    if (!locate_rigid(scene, pair)) continue;
    const double r = body[pair.sphere].radius;
    const cbm::PlaneCap cap = cbm::plane_cap(r, r - pair.distance);
    others[pair.sphere].volume += cap.volume;
    others[pair.sphere].slope += cap.slope;
  }
  packing_.part.resize(owned);
  for (std::uint32_t i = 0; i < owned; ++i) {
    const double r = body[i].radius;
    packing_.part[i] = (taken[i] + others[i].volume) / ball_volume(r);
  }
  share_pressures(scene, slopes, others, comm);
}

void SphereContacts::share_pressures(const Scene& scene, std::span<const double> slopes, std::span<const Penetration> others,
                                     const Comm& comm) {
  // The operator's Ψ″/V (g_s + g_o)(g_s + g_o)ᵀ, spheres s exactly and the others o by their points alone: with S and T the sums of their
  // slopes, (u + w)² ≤ (1 + T/S) u² + (1 + S/T) w², and w² ≤ T Σ |slope| w_k² (Cauchy and Schwarz).
  const std::size_t first = scene.first_sphere(), count = scene.bodies().size() - first;
  std::vector<Vec3d> shared(scene.point_count());  // p, resistance among spheres, resistance against others
  bool resists = false;
  for (std::size_t i = 0; i < scene.owned_spheres(); ++i) {
    const ContactBody& body = scene.bodies()[first + i];
    const auto value = model_.types[body.material].sphere.packing.at(packing_.part[i]);
    const double stiffness = value.slope / ball_volume(body.radius);
    const double s = slopes[i], t = others[i].slope;
    shared[body.first_point] = {value.pressure, s > 0.0 ? stiffness * (1.0 + t / s) : 0.0, stiffness * (s + t)};
    resists = resists || stiffness > 0.0;
  }
  list_.packing.on = comm.any(resists);
  scene.exchange(std::span(shared));
  packing_.pressure.resize(count);
  list_.packing.resistance.resize(count);
  packing_.on_surfaces.assign(scene.bodies().size(), {});
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d& here = shared[scene.bodies()[first + i].first_point];
    packing_.pressure[i] = here.x;
    list_.packing.resistance[i] = static_cast<float>(here.y);
    packing_.on_surfaces[first + i] = {here.x, here.z};
  }
  list_.packing.exchange = [&scene](std::span<Float4> by_point) { scene.exchange(by_point); };
}

SphereContacts::PackingForce SphereContacts::packing_force(const Scene& scene, const SpherePair& pair, double distance) const {
  const ContactBody* body = scene.bodies().data() + scene.first_sphere();
  const double p_a = packing_.pressure[pair.a], p_b = packing_.pressure[pair.b];
  PackingForce out;
  if (p_a == 0.0 && p_b == 0.0 && list_.packing.resistance[pair.a] == 0.0f && list_.packing.resistance[pair.b] == 0.0f) return out;
  out.caps = cbm::sphere_caps(body[pair.a].radius, body[pair.b].radius, distance);
  out.force = p_a * out.caps.slope_a + p_b * out.caps.slope_b;
  out.stiffness = std::max(0.0, p_a * out.caps.curvature_a + p_b * out.caps.curvature_b);
  return out;
}

}  // namespace morula
