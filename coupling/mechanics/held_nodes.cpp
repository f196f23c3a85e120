#include "coupling/mechanics/held_nodes.h"

#include <algorithm>
#include <cmath>

namespace morula {
namespace {

/// √k/n: K = (√k/n)² between any two points of a spring.
float weight(const Anchor& spring) { return static_cast<float>(std::sqrt(spring.stiffness) / spring.count); }

}  // namespace

void HeldNodes::hold(std::uint32_t node, const Vec3d& along, double stiffness) {
  const Vec3d v = along * std::sqrt(stiffness);
  held_.push_back({node, static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
}

void HeldNodes::add_product(std::span<const Float4> p, std::span<Float4> q) const {
  for (const Held& h : held_) {
    const Float4& v = p[h.node];
    const float part = dt_ * (h.x * v.x + h.y * v.y + h.z * v.z);
    q[h.node].x += part * h.x;
    q[h.node].y += part * h.y;
    q[h.node].z += part * h.z;
  }
}

void HeldNodes::add_diagonal(std::span<SymMat3<float>> diagonal) const {
  for (const Held& h : held_) {
    SymMat3<float>& a = diagonal[h.node];
    a.xx += dt_ * h.x * h.x, a.xy += dt_ * h.x * h.y, a.xz += dt_ * h.x * h.z;
    a.yy += dt_ * h.y * h.y, a.yz += dt_ * h.y * h.z, a.zz += dt_ * h.z * h.z;
  }
}

void Grips::begin_step(const World& world, StepStart&) {
  springs_.assign(anchors_.begin(), anchors_.end());
  const std::uint32_t nodes = world.scene.owned_nodes();
  for (Anchor& spring : springs_)
    if (spring.node >= nodes) spring.node += world.scene.sphere_point() - nodes;
}

void Grips::add_outside(const Way& way, double dt, std::span<Vec3d> out, OrderFreeSum& work) {
  for (const Anchor& spring : springs_) {
    const Vec3d from = spring.mean(way.start, spring.node), at = spring.mean(way.position, spring.node);
    const Vec3d push = (at - spring.target) * (spring.stiffness * dt / spring.count);
    for (Vec3d& to : out.subspan(spring.node, spring.count)) to += push;
    work.add(0.5 * spring.stiffness * (norm2(from - spring.target) - norm2(at - spring.target)));  // energy at the start less that now
  }
}

void Grips::add_tied(const World& world, std::vector<std::uint32_t>& bodies) const {
  const auto first_node = world.scene.first_node().first(world.scene.owned_shells() + 1);
  const std::uint32_t nodes = world.scene.owned_nodes();
  for (const Anchor& anchor : anchors_) {
    const auto shell = std::upper_bound(first_node.begin(), first_node.end(), anchor.node) - first_node.begin() - 1;
    bodies.push_back(static_cast<std::uint32_t>(anchor.node < nodes ? shell : world.scene.first_sphere() + (anchor.node - nodes)));
  }
}

void Grips::add_product(std::span<const Float4> p, std::span<Float4> q) const {
  for (const Anchor& spring : springs_) {
    Float4 sum{};
    for (const Float4& v : p.subspan(spring.node, spring.count)) sum.x += v.x, sum.y += v.y, sum.z += v.z;
    const float w = weight(spring), x = dt_ * (w * sum.x) * w, y = dt_ * (w * sum.y) * w, z = dt_ * (w * sum.z) * w;
    for (Float4& to : q.subspan(spring.node, spring.count)) to.x += x, to.y += y, to.z += z;
  }
}

void Grips::add_diagonal(std::span<SymMat3<float>> diagonal) const {
  for (const Anchor& spring : springs_) {
    const float w = weight(spring), part = dt_ * w * w;
    for (SymMat3<float>& block : diagonal.subspan(spring.node, spring.count)) block.xx += part, block.yy += part, block.zz += part;
  }
}

}  // namespace morula
