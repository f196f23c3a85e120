/// The motion of the tissue as a whole: what no force between cells may change (time_stepping.md §11.1, decision 0024).
#include <array>

#include "core/parallel/threads.h"
#include "coupling/mechanics/mechanics.h"

namespace morula {
namespace {

constexpr double kLeastInertia = 1e-9;  // of a direction about which nothing turns, in units of the largest

Vec3d to_double(const Float4& v) { return {v.x, v.y, v.z}; }

/// Sums over points of friction γ, place x and way d.
struct MotionSums {
  static constexpr std::size_t kTerms = 17;
  std::array<double, kTerms> term{};

  void add(const SymMat3<double>& friction, const Vec3d& x, const Vec3d& d) {
    const double weight = (friction.xx + friction.yy + friction.zz) / 3.0;
    const Vec3d push = friction * d, torque = cross(x, push);
    const double values[kTerms] = {weight,
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
    for (std::size_t k = 0; k < kTerms; ++k) term[k] += values[k];
  }
};

TissueMotion motion_of(const std::array<double, MotionSums::kTerms>& t, bool rotates) {
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

}  // namespace

void Mechanics::find_clusters(const Tissue& tissue, std::span<const ElementGroup> groups) {
  std::vector<std::uint32_t> tied;
  const auto first_node = scene_.first_node().first(scene_.owned_shells() + 1);
  for (const Anchor& anchor : anchors_)
    tied.push_back(
        static_cast<std::uint32_t>(std::upper_bound(first_node.begin(), first_node.end(), anchor.node) - first_node.begin() - 1));
  // Springs on marked faces pull towards a sphere that stands still during the step.
  for (const ApicalSpring& spring : model_.apical_springs)
    for (std::uint32_t s = 0; s < scene_.owned_shells(); ++s) {
      const auto& marks = tissue.shells.faces_of(s).mark;
      if (std::any_of(marks.begin(), marks.end(), [&](std::uint8_t m) { return (m >> spring.mark & 1) != 0; })) tied.push_back(s);
    }
  clusters_.find(scene_, groups, spheres_.pairs(), tied, comm_);
}

void Mechanics::conserve_momentum() {
  std::vector<MediumBalance> balance(scene_.bodies().size());
  const auto add = [&](std::uint32_t body, std::uint32_t point, const SymMat3<double>& friction) {
    balance[body].missing += force_[point] - friction * to_double(solution_[point]);
    balance[body].friction += friction;
  };
  parallel_for(threads_, shells_.batch_count(), [&](std::size_t batch) { shells_.for_medium_friction(batch, add); });
  for (const InteriorSystem::Nucleus& nucleus : interior_.nuclei()) balance[nucleus.shell].missing += force_[nucleus.point];
  nuclei_.for_nodes_of_shells([&](std::uint32_t shell, std::uint32_t point) { balance[shell].missing += force_[point]; });
  const auto medium = system_.point_friction();
  parallel_for(threads_, scene_.owned_spheres(), [&](std::size_t i) {
    const auto body = static_cast<std::uint32_t>(scene_.first_sphere() + i);
    add(body, scene_.bodies()[body].first_point, isotropic(static_cast<double>(medium[i])));
  });

  const std::vector<Vec3d> shift = clusters_.shifts(balance, comm_);
  const auto move = [&](std::size_t body, std::uint32_t point) {
    const Vec3f v = to_float(to_double(solution_[point]) + shift[body]);
    solution_[point] = {v.x, v.y, v.z, 0.0f};
  };
  const ContactBody* const bodies = scene_.bodies().data();
  for_active_bodies([&](std::size_t, const ContactBody& body) {
    for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i)
      move(static_cast<std::size_t>(&body - bodies), i);
  });
  for (const InteriorSystem::Nucleus& nucleus : interior_.nuclei()) move(nucleus.shell, nucleus.point);
  nuclei_.for_nodes_of_shells(move);
}

TissueMotion Mechanics::common_motion(const Tissue& tissue) const {
  constexpr std::size_t kTerms = MotionSums::kTerms;
  const auto& x = scene_.position();
  std::vector<MotionSums> of_shell(scene_.owned_shells());
  parallel_for(threads_, shells_.batch_count(), [&](std::size_t batch) {
    shells_.for_medium_friction(batch, [&](std::uint32_t shell, std::uint32_t node, const SymMat3<double>& friction) {
      const Vec3d& from = tissue.shells.position[node];
      of_shell[shell].add(friction, from, x[node] - from);
    });
  });
  std::vector<std::array<OrderFreeSum, kTerms>> sums(static_cast<std::size_t>(threads_));
  const auto count = [&](std::size_t t, const MotionSums& part) {
    for (std::size_t k = 0; k < kTerms; ++k) sums[t][k].add(part.term[k]);
  };
  for (const MotionSums& part : of_shell) count(0, part);
  const auto medium = system_.point_friction();
  const std::size_t spheres = scene_.owned_spheres(), threads = sums.size();
  on_each_thread(threads_, [&](std::size_t t) {
    for (std::size_t i = spheres * t / threads; i < spheres * (t + 1) / threads; ++i) {
      MotionSums part;
      const Vec3d& from = tissue.spheres.position[i];
      part.add(isotropic(static_cast<double>(medium[i])), from, x[scene_.sphere_point() + i] - from);
      count(t, part);
    }
  });
  for (std::size_t t = 1; t < threads; ++t)
    for (std::size_t k = 0; k < kTerms; ++k) sums[0][k] += sums[t][k];
  std::array<double, kTerms> totals;
  comm_.sum(sums[0], totals);
  return motion_of(totals, !model_.space.any_periodic());
}

}  // namespace morula
