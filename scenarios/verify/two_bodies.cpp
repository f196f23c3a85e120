#include "scenarios/verify/two_bodies.h"

namespace morula::scenarios {

TwoBodies::TwoBodies(const TriangleMesh& mesh, double height, double gap, const ContactMaterial& material, bool objective,
                     const Vec3d& aside)
    : layer_({.range = material.law.range, .skin = 1.0, .body_skin = 2.0, .objective_friction = objective}, {}, {material}, 1) {
  topology_ = Topology::build(static_cast<std::uint32_t>(mesh.position.size()), mesh.faces).value();
  const std::uint32_t nodes = topology_->node_count(), faces = topology_->face_count();
  for (std::uint32_t k = 0; k < 2; ++k) {
    ContactBody& body = bodies_.emplace_back();
    body.id = CellId::founder(k + 1);
    body.place = k;
    body.shape = BodyShape::kSurface;
    body.point_count = nodes;
    body.first_point = k * nodes;
    for (const Vec3d& x : mesh.position) position_.push_back(x + (aside + Vec3d{0.0, 0.0, height + gap}) * static_cast<double>(k));
  }
  const std::uint32_t first_node[3] = {0, nodes, 2 * nodes};
  topologies_[0] = topologies_[1] = topology_.get();
  first_face_[1] = faces, first_face_[2] = 2 * faces;
  compute_surface_geometry({topologies_, first_node, first_face_}, position_, geometry_);
  gradient_.set_zero(2 * nodes, 2 * nodes, 2 * faces);
  layer_.rebuild(scene(position_), {.box = {{-50, -50, -50}, {50, 50, 50}}});
  layer_.evaluate(scene(position_), SurfacePairKind::kSurfaces, gradient_);
  const std::span<const Vec3d> position = position_;
  for (std::size_t k = 0; k < 2; ++k) area_ += 0.5 * gradient_.contact_area(topology_->faces(), position.subspan(k * nodes), k * faces);
  layer_.begin_step(scene(position_));
}

ContactScene TwoBodies::scene(const std::vector<Vec3d>& position) const {
  return {bodies_, position, topologies_, first_face_, &geometry_};
}

Vec3d TwoBodies::force() const {
  Vec3d out{};
  for (std::size_t i = topology_->node_count(); i < position_.size(); ++i) out += gradient_.force[i];
  return out;
}

TwoBodies::Drag TwoBodies::drag(const std::vector<Vec3d>& way) {
  std::vector<Vec3d> moved = position_;
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += way[i];
  Drag out;
  out.force.resize(moved.size());
  OrderFreeSum sum;
  layer_.add_step_friction(scene(moved), position_, true, out.force, sum);
  out.dissipation = Comm().sum(sum);
  return out;
}

std::vector<Vec3d> TwoBodies::slide(bool upper, const Vec3d& way) const {
  std::vector<Vec3d> out(position_.size());
  const std::size_t nodes = topology_->node_count();
  for (std::size_t i = 0; i < nodes; ++i) out[upper ? nodes + i : i] = way;
  return out;
}

}  // namespace morula::scenarios
