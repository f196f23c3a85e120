/// The motion of the tissue as a whole: what no force between cells may change (time_stepping.md §11.1, decision 0024).
#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel/bounded_sums.h"
#include "core/parallel/threads.h"
#include "coupling/mechanics/step.h"

namespace morula {
namespace {

constexpr double kLeastInertia = 1e-9;  // of a direction about which nothing turns, in units of the largest
/// Square of the extent over that of the way from the origin, below which all is one point, a sphere, but for rounding.
constexpr double kLeastExtent = 1e-9;

/// What is summed over points of friction γ, place x and way d.
constexpr std::size_t kTerms = 17;
using MotionTerms = std::array<double, kTerms>;

MotionTerms motion_terms(double weight, const Vec3d& push, const Vec3d& x, const Vec3d& d) {
  const Vec3d torque = cross(x, push);
  return {weight,
          weight * x.x,
          weight * x.y,
          weight * x.z,
          push.x,
          push.y,
          push.z,
          torque.x,
          torque.y,
          torque.z,
          weight * norm(d),
          weight * x.x * x.x,
          weight * x.x * x.y,
          weight * x.x * x.z,
          weight * x.y * x.y,
          weight * x.y * x.z,
          weight * x.z * x.z};
}

using MotionSums = BoundedSums<kTerms>;

/// For weights, places and ways up to these.
MotionSums motion_sums(double weight, double place, double way) {
  const double w = 4.0 * weight;  // 4: friction that is not isotropic
  const double x = w * place, d = w * way, xd = x * way, xx = x * place;
  return MotionSums({w, x, x, x, d, d, d, xd, xd, xd, d, xx, xx, xx, xx, xx, xx});
}

TissueMotion motion_of(const MotionTerms& t, bool rotates) {
  TissueMotion out;
  const double weight = t[0];
  if (!(weight > 0.0)) return out;
  const Vec3d centre = Vec3d{t[1], t[2], t[3]} * (1.0 / weight), push{t[4], t[5], t[6]};
  out.drift = push * (1.0 / weight);
  out.way = t[10] / weight;
  if (!rotates) return out;
  const Vec3d torque = Vec3d{t[7], t[8], t[9]} - cross(centre, push);
  const SymMat3<double> about_origin{t[11], t[12], t[13], t[14], t[15], t[16]}, second = about_origin + outer(-weight, centre);
  const double trace = second.xx + second.yy + second.zz;
  if (!(trace > kLeastExtent * (about_origin.xx + about_origin.yy + about_origin.zz))) return out;
  // Points on one line do not turn about it: there the torque is zero, and a little inertia keeps the quotient zero.
  out.rotation = inverse(isotropic(trace * (1.0 + kLeastInertia)) + -1.0 * second) * torque;
  return out;
}

}  // namespace

void conserve_momentum(Workspace& work, std::span<const Vec3d> right) {
  const Scene& scene = work.scene;
  const int threads = work.setting.threads;
  const ShellSystem& shells = work.terms.membranes->shells();
  std::vector<Float4>& velocity = work.solver.velocity;
  std::vector<OutsideBalance> balance(scene.bodies().size());
  const auto add = [&](std::uint32_t body, std::uint32_t point, const SymMat3<double>& friction) {
    balance[body].missing += right[point] - friction * to_double(velocity[point]);
    balance[body].resistance += friction;
  };
  parallel_for(threads, shells.batch_count(),
               [&](std::size_t batch) { shells.for_medium_friction(batch, work.terms.node_friction->friction(), add); });
  for (const Scene::Inner& inner : scene.inner())
    for (std::uint32_t i = inner.first_point; i < inner.first_point + inner.point_count; ++i) balance[inner.shell].missing += right[i];
  const auto medium = work.solver.system.point_friction();
  parallel_for(threads, scene.owned_spheres(), [&](std::size_t i) {
    const auto body = static_cast<std::uint32_t>(scene.first_sphere() + i);
    add(body, scene.bodies()[body].first_point, isotropic(static_cast<double>(medium[i])));
  });
  for (const HeldPoint& held : work.solver.held) {
    balance[held.body].missing -= held.block * to_double(velocity[held.point]);
    balance[held.body].resistance += held.block;
  }
  for (const auto& term : work.terms.all) term->add_outside_balance(velocity, balance);

  const std::vector<Vec3d> shift = work.solver.clusters.shifts(balance, work.setting.comm);
  const auto move = [&](std::size_t body, std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Vec3f v = to_float(to_double(velocity[i]) + shift[body]);
      velocity[i] = {v.x, v.y, v.z, 0.0f};
    }
  };
  const ContactBody* const bodies = scene.bodies().data();
  work.points().for_bodies(
      [&](std::size_t, const ContactBody& body) { move(static_cast<std::size_t>(&body - bodies), body.first_point, body.point_count); });
  for (const Scene::Inner& inner : scene.inner()) move(inner.shell, inner.first_point, inner.point_count);
}

TissueMotion common_motion(const Workspace& work, const Tissue& tissue) {
  const Scene& scene = work.scene;
  const Comm& comm = work.setting.comm;
  const int threads = work.setting.threads;
  const auto& x = scene.position();
  const auto medium = work.solver.system.point_friction();
  const std::size_t spheres = scene.owned_spheres(), nodes = scene.owned_nodes();
  const auto start = [&](std::size_t i) { return i < nodes ? tissue.shells.position[i] : tissue.spheres.position[i - nodes]; };
  const auto way = [&](std::size_t i) { return x[i < nodes ? i : scene.sphere_point() + i - nodes] - start(i); };

  const ShellSystem& shells = work.terms.membranes->shells();
  std::vector<MotionTerms> of_shell(scene.owned_shells());
  parallel_for(threads, shells.batch_count(), [&](std::size_t batch) {
    shells.for_medium_friction(batch, work.terms.node_friction->friction(),
                               [&](std::uint32_t shell, std::uint32_t node, const SymMat3<double>& friction) {
                                 const double weight = (friction.xx + friction.yy + friction.zz) / 3.0;
                                 const Vec3d d = way(node);
                                 const MotionTerms terms = motion_terms(weight, friction * d, start(node), d);
                                 for (std::size_t k = 0; k < kTerms; ++k) of_shell[shell][k] += terms[k];
                               });
  });
  double weight = parallel_max(threads, spheres, [&](std::size_t i) { return static_cast<double>(medium[i]); });
  for (const MotionTerms& terms : of_shell) weight = std::max(weight, terms[0]);
  const double furthest = parallel_max(threads, nodes + spheres, [&](std::size_t i) { return norm2(start(i)); });
  const double most = parallel_max(threads, nodes + spheres, [&](std::size_t i) { return norm2(way(i)); });
  MotionSums sums = motion_sums(comm.max(weight), std::sqrt(comm.max(furthest)), std::sqrt(comm.max(most)));
  for (const MotionTerms& terms : of_shell) sums.add(terms);
  const auto of_sphere = [&](std::size_t i) {
    const double friction = medium[i];
    const Vec3d d = way(nodes + i);
    return motion_terms(friction, d * friction, start(nodes + i), d);
  };
  return motion_of(totals_of(sums, threads, spheres, of_sphere, comm), !work.setting.model.space.any_periodic());
}

}  // namespace morula
