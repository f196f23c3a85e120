#include "coupling/mechanics/node_friction.h"

#include <algorithm>

namespace morula {
namespace {

bool has_node_friction(const Model& model) {
  return std::ranges::any_of(model.types, [](const CellType& t) { return t.medium_normal_extra > 0.0 || t.medium_tangent_extra > 0.0; });
}

}  // namespace

std::vector<SymMat3<double>> NodeFriction::at(const Tissue& tissue, const SurfaceGeometry& geometry) const {
  std::vector<SymMat3<double>> out;
  if (!has_node_friction(model_)) return out;
  const dcm::Shells& shells = tissue.shells;
  out.resize(shells.node_count());
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const CellType& type = model_.types[shells.type[s]];
    for (std::uint32_t i = shells.first_node[s]; i < shells.first_node[s + 1]; ++i) {
      const double area = geometry.node_area[i];
      out[i] += outer(area * (type.medium_normal_extra - type.medium_tangent_extra), geometry.node_normal[i]);
      out[i] += isotropic(area * type.medium_tangent_extra);
    }
  }
  return out;
}

void NodeFriction::add_friction(const World& world, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) {
  if (!way.moved || friction_.empty()) return;
  const dcm::Shells& shells = world.tissue.shells;
  for (std::size_t s = 0; s < shells.size(); ++s) {
    double of_shell = 0.0;
    for (std::uint32_t i = shells.first_node[s]; i < shells.first_node[s + 1]; ++i) {
      const Vec3d displacement = way.position[i] - way.start[i];
      const Vec3d push = friction_[i] * displacement;
      out[i] += push;
      of_shell += dot(displacement, push);
    }
    quadratic.add(of_shell);
  }
}

void NodeFriction::assemble(const World&, double, Assembly& out) {
  out.node_block.resize(std::max(out.node_block.size(), friction_.size()));
  for (std::size_t i = 0; i < friction_.size(); ++i) out.node_block[i] += friction_[i];
}

}  // namespace morula
