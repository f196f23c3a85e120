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

Vec3d to_double(const Float4& v) { return {v.x, v.y, v.z}; }

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
  const SymMat3<double> second = SymMat3<double>{t[11], t[12], t[13], t[14], t[15], t[16]} + outer(-weight, centre);
  const double trace = second.xx + second.yy + second.zz;
  if (!(trace > 0.0)) return out;
  // Points on one line do not turn about it: there the torque is zero, and a little inertia keeps the quotient zero.
  out.rotation = inverse(isotropic(trace * (1.0 + kLeastInertia)) + -1.0 * second) * torque;
  return out;
}

/// [x]× as rows of a matrix: [x]× v = x × v.
std::array<Vec3d, 3> cross_matrix(const Vec3d& x) { return {Vec3d{0.0, -x.z, x.y}, Vec3d{x.z, 0.0, -x.x}, Vec3d{-x.y, x.x, 0.0}}; }

/// What turns a cluster and what resists: Σ b − C v and its torque, and the blocks of Σ [I; [x]×] C [I; [x]×]ᵀ.
struct Turning {
  static constexpr std::size_t kTerms = 28;

  Vec3d missing{}, torque{};
  SymMat3<double> resistance{}, turning{};
  std::array<Vec3d, 3> coupling{};  ///< Σ [x]× C, rows
  double held = 0.0;                ///< bodies that do not turn with the others

  /// A point that lacks a force, and its friction C.
  void add(const Vec3d& x, const Vec3d& push, const SymMat3<double>& friction) {
    missing += push;
    torque += cross(x, push);
    resistance += friction;
    const std::array<Vec3d, 3> arm = cross_matrix(x);
    std::array<Vec3d, 3> half;  // C [x]×ᵀ, columns
    for (std::size_t i = 0; i < 3; ++i) half[i] = friction * arm[i], coupling[i] += half[i];
    turning += SymMat3<double>{dot(arm[0], half[0]), dot(arm[0], half[1]), dot(arm[0], half[2]),
                               dot(arm[1], half[1]), dot(arm[1], half[2]), dot(arm[2], half[2])};
  }
  /// v = V + ω × x of the rigid motion that leaves neither force nor torque: V [µm/s], ω [1/s].
  struct Motion {
    Vec3d velocity{}, rotation{};
  };
  [[nodiscard]] Motion motion() const {
    if (held > 0.0 || !(determinant(resistance) > 0.0)) return {};
    const SymMat3<double> mobility = inverse(resistance);
    const std::array<Vec3d, 3> rows{mobility * coupling[0], mobility * coupling[1], mobility * coupling[2]};  // of coupling · mobility
    const SymMat3<double> alone =
        turning + -1.0 * SymMat3<double>{dot(rows[0], coupling[0]), dot(rows[0], coupling[1]), dot(rows[0], coupling[2]),
                                         dot(rows[1], coupling[1]), dot(rows[1], coupling[2]), dot(rows[2], coupling[2])};
    Motion out;
    out.rotation = inverse(alone) * (torque - Vec3d{dot(rows[0], missing), dot(rows[1], missing), dot(rows[2], missing)});
    Vec3d turned{};  // couplingᵀ ω
    for (std::size_t i = 0; i < 3; ++i) turned += coupling[i] * out.rotation[i];
    out.velocity = mobility * (missing - turned);
    return out;
  }

  void write(double* to) const {
    const auto put = [&](const auto&... values) { ((*to++ = values), ...); };
    for (const Vec3d& v : {missing, torque}) put(v.x, v.y, v.z);
    for (const SymMat3<double>& m : {resistance, turning}) put(m.xx, m.xy, m.xz, m.yy, m.yz, m.zz);
    for (const Vec3d& row : coupling) put(row.x, row.y, row.z);
    put(held);
  }
  static Turning read(const double* from) {
    const auto vector = [&] { return from += 3, Vec3d{from[-3], from[-2], from[-1]}; };
    const auto matrix = [&] { return from += 6, SymMat3<double>{from[-6], from[-5], from[-4], from[-3], from[-2], from[-1]}; };
    Turning out;
    out.missing = vector(), out.torque = vector(), out.resistance = matrix(), out.turning = matrix();
    for (Vec3d& row : out.coupling) row = vector();
    out.held = *from;
    return out;
  }
};

/// Turns shells that nothing holds, so that no torque is left: neither the energy of a shell nor the friction within it knows how it lies, but the matrix, whose
/// tensions resist every motion of two nodes against each other, does. Single ones, and clusters whose contacts rub as objective_friction.h has it: friction of the
/// usual form acts across the gap between two surfaces and has a torque of its own, which only the matrix knows.
void turn_clusters(Workspace& work, std::span<const Vec3d> right) {
  const Scene& scene = work.scene;
  const Comm& comm = work.setting.comm;
  if (work.setting.model.space.any_periodic()) return;
  std::vector<char> turns = work.solver.clusters.among_shells(scene, work.setting.model.contact.objective_friction);
  if (!comm.any(std::ranges::find(turns, 1) != turns.end())) return;
  std::vector<Float4>& velocity = work.solver.velocity;
  std::vector<OutsideBalance> outside(scene.bodies().size());  // but for the medium
  for (const HeldPoint& point : work.solver.held) outside[point.body].resistance += point.block;
  for (const auto& term : work.terms.all) term->add_outside_balance(velocity, outside);
  std::vector<Turning> turning(turns.size());
  for (std::size_t shell = 0; shell < turns.size(); ++shell) {
    const SymMat3<double>& held = outside[shell].resistance;
    turns[shell] = turns[shell] && held.xx + held.yy + held.zz == 0.0;
    turning[shell].held = !turns[shell];
  }
  const auto& x = scene.position();
  const ShellSystem& shells = work.terms.membranes->shells();
  parallel_for(work.setting.threads, shells.batch_count(), [&](std::size_t batch) {
    shells.for_medium_friction(batch, work.terms.node_friction->friction(),
                               [&](std::uint32_t shell, std::uint32_t node, const SymMat3<double>& friction) {
                                 if (turns[shell])
                                   turning[shell].add(x[node], right[node] - friction * to_double(velocity[node]), friction);
                               });
  });
  for (const Scene::Inner& inner : scene.inner())
    for (std::uint32_t i = inner.first_point; turns[inner.shell] && i < inner.first_point + inner.point_count; ++i)
      turning[inner.shell].add(x[i], right[i], {});
  std::vector<double> terms(turns.size() * Turning::kTerms);
  for (std::size_t shell = 0; shell < turns.size(); ++shell) turning[shell].write(terms.data() + shell * Turning::kTerms);
  const std::vector<double> totals = work.solver.clusters.totals(scene, terms, Turning::kTerms, comm);
  const auto move = [&](std::uint32_t shell, std::uint32_t first, std::uint32_t count) {
    if (!turns[shell]) return;
    const Turning::Motion motion = Turning::read(totals.data() + shell * Turning::kTerms).motion();
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Vec3f v = to_float(to_double(velocity[i]) + motion.velocity + cross(motion.rotation, x[i]));
      velocity[i] = {v.x, v.y, v.z, 0.0f};
    }
  };
  for (std::uint32_t shell = 0; shell < turns.size(); ++shell)
    move(shell, scene.first_node()[shell], scene.first_node()[shell + 1] - scene.first_node()[shell]);
  for (const Scene::Inner& inner : scene.inner()) move(inner.shell, inner.first_point, inner.point_count);
}

}  // namespace

void conserve_momentum(Workspace& work, std::span<const Vec3d> right) {
  const Scene& scene = work.scene;
  const int threads = work.setting.threads;
  const ShellSystem& shells = work.terms.membranes->shells();
  std::vector<Float4>& velocity = work.solver.velocity;
  turn_clusters(work, right);
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
