#include "coupling/mechanics/held_nodes.h"

#include <algorithm>
#include <cmath>

#include "core/contact/float_rounding.h"
#include "core/mesh/topology.h"

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

Vec3d Grips::Spring::place(std::span<const Vec3d> all) const {
  return faces.empty() ? all[first] : volume_centroid(faces, all.subspan(first, count));
}

std::vector<CentroidGradient> Grips::Spring::gradient(std::span<const Vec3d> all) const {
  if (!faces.empty()) return volume_centroid_gradient(faces, all.subspan(first, count));
  return {{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}};
}

void Grips::begin_step(const World& world, StepStart&) {
  springs_.clear();
  const std::uint32_t nodes = world.scene.owned_nodes();
  const auto first_node = world.scene.first_node().first(world.scene.owned_shells() + 1);
  for (const Anchor& anchor : anchors_) {
    const auto shell = static_cast<std::size_t>(anchor.shell);
    const bool whole = anchor.shell >= 0;
    const auto shell_of_node = std::upper_bound(first_node.begin(), first_node.end(), anchor.node) - first_node.begin() - 1;
    springs_.push_back({.stiffness = anchor.stiffness,
                        .target = anchor.target,
                        .body = static_cast<std::uint32_t>(anchor.node < nodes ? static_cast<std::size_t>(shell_of_node)
                                                                               : world.scene.first_sphere() + (anchor.node - nodes)),
                        .first = anchor.node < nodes ? anchor.node : anchor.node - nodes + world.scene.sphere_point(),
                        .count = whole ? first_node[shell + 1] - first_node[shell] : 1,
                        .faces = whole ? world.scene.topologies()[shell]->faces() : std::span<const Triangle>{}});
  }
}

void Grips::add_outside(const Way& way, double dt, std::span<Vec3d> out, OrderFreeSum& work) {
  for (const Spring& spring : springs_) {
    const Vec3d from = spring.place(way.start), at = spring.place(way.position);
    const Vec3d push = (at - spring.target) * (spring.stiffness * dt);
    const auto gradient = spring.gradient(way.position);
    for (std::uint32_t i = 0; i < spring.count; ++i) out[spring.first + i] += transposed_product(gradient[i], push);
    work.add(0.5 * spring.stiffness * (norm2(from - spring.target) - norm2(at - spring.target)));  // energy at the start less that now
  }
}

void Grips::assemble(const World& world, double dt, Assembly&) {
  dt_ = dt;
  columns_.clear();
  for (const Spring& spring : springs_) {
    const double root = std::sqrt(dt * spring.stiffness);
    for (const CentroidGradient& of_point : spring.gradient(world.position()))
      columns_.push_back({to_float(of_point[0] * root), to_float(of_point[1] * root), to_float(of_point[2] * root)});
  }
}

void Grips::add_outside_balance(std::span<const Float4> velocity, std::span<OutsideBalance> by_body) const {
  const Column* column = columns_.data();
  for (const Spring& spring : springs_) {
    const double all = dt_ * spring.stiffness;  // of a common velocity: Σ W = 1
    Vec3d sum;                                  // √(Δt k) Σ W v
    for (std::uint32_t i = 0; i < spring.count; ++i, ++column) {
      const Vec3d way = to_double(velocity[spring.first + i]);
      sum += Vec3d{dot(to_double((*column)[0]), way), dot(to_double((*column)[1]), way), dot(to_double((*column)[2]), way)};
    }
    by_body[spring.body].missing -= sum * std::sqrt(all);
    by_body[spring.body].resistance += isotropic(all);
  }
}

void Grips::add_product(std::span<const Float4> p, std::span<Float4> q) const {
  const Column* columns = columns_.data();
  for (const Spring& spring : springs_) {
    Vec3f sum{};  // √(Δt k) Σ W p
    for (std::uint32_t i = 0; i < spring.count; ++i) {
      const Float4& v = p[spring.first + i];
      const Vec3f way{v.x, v.y, v.z};
      sum += Vec3f{dot(columns[i][0], way), dot(columns[i][1], way), dot(columns[i][2], way)};
    }
    for (std::uint32_t i = 0; i < spring.count; ++i) {
      const Vec3f part = transposed_product(columns[i], sum);
      Float4& to = q[spring.first + i];
      to.x += part.x, to.y += part.y, to.z += part.z;
    }
    columns += spring.count;
  }
}

void Grips::add_diagonal(std::span<SymMat3<float>> diagonal) const {
  const Column* column = columns_.data();
  for (const Spring& spring : springs_)
    for (std::uint32_t i = 0; i < spring.count; ++i, ++column)
      for (const Vec3f& row : *column) diagonal[spring.first + i] += outer(1.0f, row);
}

}  // namespace morula
