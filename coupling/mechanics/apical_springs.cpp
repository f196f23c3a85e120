#include "coupling/mechanics/apical_springs.h"

#include <algorithm>

#include "coupling/face_marks.h"

namespace morula {
namespace {

/// Σ terms(node) over the marked nodes of all ranks: in fixed order within a shell, order-free over shells.
template <std::size_t N, class ByShell, class Terms>
std::array<double, N> total(const ByShell& list, const Comm& comm, const Terms& terms) {
  std::array<OrderFreeSum, N> sums;
  std::size_t k = 0;
  for (const std::size_t end : list.ends) {
    std::array<double, N> of_shell{};
    for (; k < end; ++k) {
      const std::array<double, N> more = terms(list.nodes[k]);
      for (std::size_t n = 0; n < N; ++n) of_shell[n] += more[n];
    }
    for (std::size_t n = 0; n < N; ++n) sums[n].add(of_shell[n]);
  }
  std::array<double, N> out;
  comm.sum(sums, out);
  return out;
}

Vec3d to_double(const Float4& v) { return {v.x, v.y, v.z}; }

}  // namespace

void ApicalSprings::add_joined(const World&, std::vector<std::vector<std::uint32_t>>& bodies) const {
  for (const Spring& spring : springs_) bodies.push_back(spring.marked.shells);
}

void ApicalSprings::set_weights(const dcm::Shells& shells, const Comm& comm) {
  springs_.assign(model_.apical_springs.size(), {});
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    Spring& spring = springs_[k];
    const std::vector<double> area = marked_node_areas(shells, model_.apical_springs[k].mark);
    for (std::uint32_t s = 0; s < shells.size(); ++s)
      for (std::uint32_t i = shells.first_node[s]; i < shells.first_node[s + 1]; ++i)
        if (area[i] > 0.0) spring.marked.add(s, {i, area[i]});
    spring.area = total<1>(spring.marked, comm, [](const Marked& at) { return std::array{at.area}; })[0];
  }
}

void ApicalSprings::find_spheres(std::span<const Vec3d> x, const Comm& comm) {
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    Spring& spring = springs_[k];
    if (!(spring.area > 0.0)) continue;
    const double share = 1.0 / spring.area;
    const auto mean = [&](const auto& of_node) {  // of a vector, by area
      const auto sums = total<3>(spring.marked, comm, [&](const Marked& at) {
        const Vec3d v = of_node(x[at.node]) * at.area;
        return std::array{v.x, v.y, v.z};
      });
      return Vec3d{sums[0], sums[1], sums[2]} * share;
    };
    spring.center = mean([](const Vec3d& at) { return at; });
    spring.radius =
        total<1>(spring.marked, comm, [&](const Marked& at) { return std::array{at.area * norm(x[at.node] - spring.center)}; })[0] * share;
    spring.pull = mean([&](const Vec3d& at) {
      const Vec3d from = at - spring.center;
      const double length = norm(from);
      return length > 0.0 ? from * (model_.apical_springs[k].stiffness * (1.0 - spring.radius / length)) : Vec3d{};
    });
  }
}

void ApicalSprings::add_forces(std::span<const Vec3d> x, std::span<Vec3d> force, OrderFreeSum& energy) const {
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    const Spring& spring = springs_[k];
    const double stiffness = model_.apical_springs[k].stiffness;
    std::size_t n = 0;
    for (const std::size_t end : spring.marked.ends) {
      double of_shell = 0.0;
      for (; n < end; ++n) {
        const auto& [node, area] = spring.marked.nodes[n];
        const Vec3d from = x[node] - spring.center;
        const double length = norm(from), off = length - spring.radius;
        of_shell += 0.5 * stiffness * area * off * off;
        force[node] += spring.pull * area;
        if (length > 0.0) force[node] -= from * (area * stiffness * off / length);
      }
      energy.add(of_shell);
    }
  }
}

void ApicalSprings::assemble(const World& world, double dt, Assembly&) {
  if (empty()) return;
  const auto bodies = world.scene.bodies().first(world.scene.owned_shells());
  std::vector<char> moves(bodies.size());
  std::ranges::transform(bodies, moves.begin(), &ContactBody::active);
  assemble_at(world.position(), moves, dt, world.comm);
}

void ApicalSprings::assemble_at(std::span<const Vec3d> x, std::span<const char> moves, double dt, const Comm& comm) {
  comm_ = &comm;
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    Spring& spring = springs_[k];
    spring.moving = {};
    if (!(spring.area > 0.0)) continue;
    spring.stiffness = dt * model_.apical_springs[k].stiffness * spring.area;
    const auto direction = [&](std::uint32_t node) {
      const Vec3d from = x[node] - spring.center;
      const double length = norm(from);
      return length > 0.0 ? from * (1.0 / length) : Vec3d{};
    };
    std::size_t n = 0;
    for (std::size_t s = 0; s < spring.marked.shells.size(); ++s)
      for (; n < spring.marked.ends[s]; ++n) {
        const auto& [node, area] = spring.marked.nodes[n];
        if (moves.empty() || moves[spring.marked.shells[s]] != 0)
          spring.moving.add(spring.marked.shells[s], {node, area / spring.area, direction(node)});
      }
    const auto sums = total<9>(spring.marked, comm, [&](const Marked& at) {
      const double a = at.area / spring.area;
      const Vec3d d = direction(at.node);
      return std::array{a * d.x,       a * d.y,       a * d.z,       a * d.x * d.x, a * d.x * d.y,
                        a * d.x * d.z, a * d.y * d.y, a * d.y * d.z, a * d.z * d.z};
    });
    spring.normal = {sums[0], sums[1], sums[2]};
    spring.second = {sums[3], sums[4], sums[5], sums[6], sums[7], sums[8]};
  }
}

void ApicalSprings::drop_matrix() {
  for (Spring& spring : springs_) spring.moving = {};
}

void ApicalSprings::add_product(std::span<const Float4> p, std::span<Float4> q) const {
  for (const Spring& spring : springs_) {
    if (!(spring.area > 0.0)) continue;
    // With ⟨·⟩ the mean by area: s = n·(p − ⟨p⟩) − ⟨n·(p − ⟨p⟩)⟩, and q = Δt k A (n s − ⟨n s⟩).
    const auto sums = total<7>(spring.moving, *comm_, [&](const Direction& at) {
      const Vec3d v = to_double(p[at.node]) * at.weight;
      const double outward = dot(at.n, v);
      return std::array{v.x, v.y, v.z, outward, outward * at.n.x, outward * at.n.y, outward * at.n.z};
    });
    const Vec3d common{sums[0], sums[1], sums[2]};
    const double growth = sums[3] - dot(spring.normal, common);
    const Vec3d balance = Vec3d{sums[4], sums[5], sums[6]} - spring.second * common - spring.normal * growth;
    for (const Direction& at : spring.moving.nodes) {
      const double change = dot(at.n, to_double(p[at.node]) - common) - growth;
      const Vec3f add = to_float((at.n * change - balance) * (spring.stiffness * at.weight));
      Float4& to = q[at.node];
      to.x += add.x, to.y += add.y, to.z += add.z;
    }
  }
}

void ApicalSprings::add_diagonal(std::span<SymMat3<float>> diagonal) const {
  // Without what the motion of the sphere takes away: it is shared by all nodes.
  for (const Spring& spring : springs_)
    for (const Direction& at : spring.moving.nodes) diagonal[at.node] += to_float(outer(spring.stiffness * at.weight, at.n));
}

std::size_t ApicalSprings::memory() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = bytes(springs_);
  for (const Spring& spring : springs_)
    total += bytes(spring.marked.nodes) + bytes(spring.moving.nodes) + 2 * bytes(spring.marked.ends) + 2 * bytes(spring.moving.ends);
  return total;
}

}  // namespace morula
