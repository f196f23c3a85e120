#include "coupling/mechanics/held_nodes.h"

#include <algorithm>
#include <cmath>

namespace morula {

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

void Grips::begin_step(const World& world, StepStart& start) {
  springs_.begin_step(world, start);
  for (const Anchor& anchor : anchors_)
    for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) springs_.hold(anchor.node, axis, anchor.stiffness);
}

void Grips::add_outside(const Way& way, double dt, std::span<Vec3d> out, OrderFreeSum& work) {
  for (const Anchor& anchor : anchors_) {
    const Vec3d &from = way.start[anchor.node], &at = way.position[anchor.node];
    out[anchor.node] += (at - anchor.target) * (anchor.stiffness * dt);
    work.add(0.5 * anchor.stiffness * (norm2(from - anchor.target) - norm2(at - anchor.target)));  // energy at the start less that now
  }
}

void Grips::add_tied(const World& world, std::vector<std::uint32_t>& bodies) const {
  const auto first_node = world.scene.first_node().first(world.scene.owned_shells() + 1);
  for (const Anchor& anchor : anchors_)
    bodies.push_back(
        static_cast<std::uint32_t>(std::upper_bound(first_node.begin(), first_node.end(), anchor.node) - first_node.begin() - 1));
}

}  // namespace morula
