#include "coupling/mechanics/shell_system.h"

#include <algorithm>

namespace morula {

ShellSystem::ShellSystem(const Model& model) {
  for (const CellType& type : model.types) {
    parameters_.push_back(type.shell);
    if (type.medium_normal_extra == 0.0 && type.medium_tangent_extra == 0.0) parameters_.back().medium_friction = type.medium_friction;
  }
}

void ShellSystem::set_shells(const dcm::Shells& shells, int threads, std::span<const char> computed) {
  shells_ = &shells;
  blocks_ = dcm::make_shell_blocks(shells, LaneBlock::kMaxLanes, computed);
  some_are_held_ = !computed.empty();
  if (some_are_held_) forces_ = {};
  blocks_.threads = threads;
}

void ShellSystem::set_deviations(const dcm::Shells& shells, std::span<const double> of_tension, std::span<const double> of_stiffness) {
  of_each_.clear();
  if (of_tension.empty() && of_stiffness.empty()) return;
  for (std::size_t i = 0; i < shells.size(); ++i) {
    dcm::ShellParameters& own = of_each_.emplace_back(parameters_[shells.type[i]]);
    if (!of_tension.empty()) own.tension *= 1.0 + of_tension[i];
    if (!of_stiffness.empty()) dcm::scale_stiffness(own, 1.0 + of_stiffness[i]);
  }
}

void ShellSystem::evaluate(const dcm::Shells& shells, std::span<const Vec3d> position, std::span<Vec3d> force,
                           std::span<const dcm::HeldVolume> held) {
  held_ = held;
  const std::size_t nodes = shells.node_count();
  if (some_are_held_) std::ranges::fill(force.first(nodes), Vec3d{});
  dcm::internal_forces(blocks_, shells, materials(), position.first(nodes), force.first(nodes), forces_, held);
}

void ShellSystem::begin_step(const dcm::Shells& shells, const SurfaceGeometry& geometry) {
  const auto node_area = std::span(geometry.node_area).first(shells.node_count());
  dcm::compute_shell_friction(blocks_, shells, materials(), shells.position, node_area, friction_);
}

void ShellSystem::assemble(const dcm::Shells& shells, std::span<const Vec3d> position, std::span<const double> face_contact_energy,
                           double dt, const EdgeBlockSource& contacts, std::span<const SymMat3<double>> node_block) {
  dcm::assemble_shell_operator(blocks_, shells, materials(), position.first(shells.node_count()), friction_,
                               face_contact_energy.first(face_contact_energy.empty() ? 0 : blocks_.face_count()), dt, contacts, operator_,
                               held_);
  node_block_.resize(node_block.size());
  std::ranges::transform(node_block, node_block_.begin(), [](const SymMat3<double>& block) { return to_float(block); });
}

void ShellSystem::add_step_friction(std::span<const Vec3d> position, std::span<Vec3d> out, OrderFreeSum& quadratic) {
  if (shells_ == nullptr || shells_->size() == 0) return;
  const std::size_t nodes = shells_->node_count();
  friction_quadratic_.resize(shells_->size());
  dcm::add_friction_of_motion(blocks_, *shells_, friction_, position.first(nodes), out.first(nodes), friction_quadratic_);
  for (const double q : friction_quadratic_) quadratic.add(q);
}

void ShellSystem::multiply(std::size_t first, std::size_t last, std::span<const Float4> p, std::span<Float4> q) const {
  dcm::apply_shell_operator(blocks_, first, last, *shells_, operator_, p.first(point_count()), q.first(point_count()));
  if (node_block_.empty()) return;
  for (std::size_t batch = first; batch < last; ++batch)
    for (const std::uint32_t shell : bodies_of(batch))
      for (std::uint32_t i = shells_->first_node[shell]; i < shells_->first_node[shell + 1]; ++i) {
        const Vec3f add = node_block_[i] * Vec3f{p[i].x, p[i].y, p[i].z};
        q[i].x += add.x, q[i].y += add.y, q[i].z += add.z;
      }
}

void ShellSystem::add_diagonal(std::span<SymMat3<float>> diagonal) const {
  dcm::add_block_diagonal(blocks_, *shells_, operator_, diagonal.first(point_count()));
  for (std::size_t i = 0; i < node_block_.size(); ++i) diagonal[i] += node_block_[i];
}

std::size_t ShellSystem::memory() const {
  std::size_t total = 0;
  for (const auto& block : operator_.blocks)
    total += block.edge.capacity() * sizeof(std::int32_t) +
             (block.diagonal.capacity() + block.volume_gradient.capacity() + block.rotation.capacity() + block.shape.capacity() +
              block.hinge.capacity() + block.membrane.capacity() + block.area_gradient.capacity() + block.bulk_gradient.capacity() +
              block.bending_weight.capacity() + block.bending_normal.capacity()) *
                 sizeof(float) +
             (block.shape_face.capacity() + block.hinge_edge.capacity()) * sizeof(std::uint32_t);
  for (const auto& block : friction_.blocks) total += (block.medium.capacity() + block.volume_gradient.capacity()) * sizeof(double);
  return total;
}

}  // namespace morula
