#include "coupling/mechanics/apical_springs.h"

#include <algorithm>

namespace morula {

void ApicalSprings::add_joined(const World&, std::vector<std::vector<std::uint32_t>>& bodies) const {
  for (const Spring& spring : springs_) bodies.push_back(spring.marked.shells);
}

void ApicalSprings::set_weights(const dcm::Shells& shells, const Comm& comm) {
  springs_.assign(model_.apical_springs.size(), {});
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    Spring& spring = springs_[k];
    spring.marked = marked_nodes(shells, model_.apical_springs[k].mark);
    spring.area = total<1>(spring.marked, comm, [](const MarkedNode& at) { return std::array{at.area}; })[0];
  }
}

void ApicalSprings::find_spheres(std::span<const Vec3d> x, const Comm& comm) {
  for (Spring& spring : springs_) {
    if (!(spring.area > 0.0)) continue;
    const double share = 1.0 / spring.area;
    const auto places = total<3>(spring.marked, comm, [&](const MarkedNode& at) {
      const Vec3d v = x[at.node] * at.area;
      return std::array{v.x, v.y, v.z};
    });
    spring.center = Vec3d{places[0], places[1], places[2]} * share;
    const auto ways = total<4>(spring.marked, comm, [&](const MarkedNode& at) {
      const Vec3d from = x[at.node] - spring.center, n = direction(from) * at.area;
      return std::array{at.area * norm(from), n.x, n.y, n.z};
    });
    spring.radius = ways[0] * share;
    spring.normal = Vec3d{ways[1], ways[2], ways[3]} * share;
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
        const double off = norm(from) - spring.radius;
        of_shell += 0.5 * stiffness * area * off * off;
        force[node] -= (direction(from) * off + spring.normal * spring.radius) * (stiffness * area);
      }
      energy.add(of_shell);
    }
  }
}

void ApicalSprings::assemble(const World& world, double dt, Assembly&) {
  if (!empty()) assemble_at(world.position(), moving_shells(world.scene), dt, world.comm);
}

void ApicalSprings::assemble_at(std::span<const Vec3d> x, std::span<const char> moves, double dt, const Comm& comm) {
  comm_ = &comm;
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    Spring& spring = springs_[k];
    spring.moving = {};
    if (!(spring.area > 0.0)) continue;
    spring.stiffness = dt * model_.apical_springs[k].stiffness * spring.area;
    spring.marked.for_each([&](std::uint32_t shell, const MarkedNode& at) {
      if (moves.empty() || moves[shell] != 0)
        spring.moving.add(shell, {at.node, at.area / spring.area, direction(x[at.node] - spring.center)});
    });
    const auto sums = total<6>(spring.marked, comm, [&](const MarkedNode& at) {
      const SymMat3<double> m = outer(at.area / spring.area, direction(x[at.node] - spring.center));
      return std::array{m.xx, m.xy, m.xz, m.yy, m.yz, m.zz};
    });
    spring.second = {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5]};
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
  std::size_t total = springs_.capacity() * sizeof(Spring);
  for (const Spring& spring : springs_) total += spring.marked.memory() + spring.moving.memory();
  return total;
}

}  // namespace morula
