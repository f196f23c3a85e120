#include "coupling/mechanics/held_nodes.h"

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

}  // namespace morula
