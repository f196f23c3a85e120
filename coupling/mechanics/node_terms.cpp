#include "coupling/mechanics/node_terms.h"

#include <algorithm>

namespace morula {
namespace {

/// A third of the areas of the marked faces around every owned node.
std::vector<double> marked_node_area(const dcm::Shells& shells, int mark) {
  std::vector<double> out(shells.node_count(), 0.0);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const MarkSets marks = shells.marks_of(s);
    if (marks.empty()) continue;
    const auto x = shells.nodes(s);
    const auto faces = shells.topology(s).faces();
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (!marks.has(f, mark)) continue;
      const Triangle& t = faces[f];
      const double third = norm(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])) / 6.0;
      for (const std::uint32_t node : t) out[shells.first_node[s] + node] += third;
    }
  }
  return out;
}

/// Sums over the marked nodes of all ranks: Σ A g(x), component by component; the last is Σ A.
template <class G>
Vec3d weighted_mean(const std::vector<double>& weight, std::span<const Vec3d> x, const Comm& comm, const G& g) {
  OrderFreeSum sums[4];
  for (std::size_t i = 0; i < weight.size(); ++i) {
    if (weight[i] == 0.0) continue;
    const Vec3d value = g(x[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) sums[axis].add(weight[i] * value[axis]);
    sums[3].add(weight[i]);
  }
  double total[4];
  comm.sum(sums, total);
  return total[3] > 0.0 ? Vec3d{total[0], total[1], total[2]} * (1.0 / total[3]) : Vec3d{};
}

}  // namespace

bool NodeTerms::has_friction() const {
  return std::any_of(model_.apical_springs.begin(), model_.apical_springs.end(), [](const ApicalSpring& s) { return s.friction > 0.0; }) ||
         std::any_of(model_.types.begin(), model_.types.end(),
                     [](const CellType& t) { return t.medium_normal_extra > 0.0 || t.medium_tangent_extra > 0.0; });
}

void NodeTerms::parameters_changed(const World& world) {
  if (!model_.apical_springs.empty()) set_springs(world.tissue, world.comm);
}

void NodeTerms::evaluate(const World& world, Forces& out) { add_forces(world.tissue.shells, world.position(), out.force, out.energy); }

void NodeTerms::add_tied(const World& world, std::vector<std::uint32_t>& bodies) const {
  // Springs on marked faces pull towards a sphere that stands still during the step.
  for (const ApicalSpring& spring : model_.apical_springs)
    for (std::uint32_t s = 0; s < world.scene.owned_shells(); ++s)
      if (world.tissue.shells.marks_of(s).any_has(spring.mark)) bodies.push_back(s);
}

void NodeTerms::assemble(const World& world, double dt, Assembly& out) {
  const std::vector<SymMat3<double>> stiff = stiffness(world.position(), world.scene.owned_nodes());
  out.node_block.resize(std::max(out.node_block.size(), stiff.size()));
  for (std::size_t i = 0; i < stiff.size(); ++i) out.node_block[i] += dt * stiff[i];
}

void NodeFriction::begin_step(const World& world, StepStart&) { friction_ = nodes_.friction(world.tissue, world.geometry); }

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

void NodeTerms::set_springs(const Tissue& tissue, const Comm& comm) {
  spheres_.resize(model_.apical_springs.size());
  const std::span<const Vec3d> x = tissue.shells.position;
  for (std::size_t k = 0; k < spheres_.size(); ++k) {
    Sphere& sphere = spheres_[k];
    sphere.weight = marked_node_area(tissue.shells, model_.apical_springs[k].mark);
    sphere.center = weighted_mean(sphere.weight, x, comm, [](const Vec3d& at) { return at; });
    sphere.radius = weighted_mean(sphere.weight, x, comm, [&](const Vec3d& at) { return Vec3d{norm(at - sphere.center), 0.0, 0.0}; }).x;
    sphere.pull = weighted_mean(sphere.weight, x, comm, [&](const Vec3d& at) {
      const Vec3d from = at - sphere.center;
      const double length = norm(from);
      return length > 0.0 ? from * (model_.apical_springs[k].stiffness * (1.0 - sphere.radius / length)) : Vec3d{};
    });
  }
}

std::vector<SymMat3<double>> NodeTerms::friction(const Tissue& tissue, const SurfaceGeometry& geometry) const {
  std::vector<SymMat3<double>> out;
  if (!has_friction()) return out;
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
  for (std::size_t k = 0; k < spheres_.size(); ++k)
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += isotropic(model_.apical_springs[k].friction * spheres_[k].weight[i]);
  return out;
}

void NodeTerms::add_forces(const dcm::Shells& shells, std::span<const Vec3d> x, std::span<Vec3d> force, OrderFreeSum& energy) const {
  for (std::size_t k = 0; k < spheres_.size(); ++k) {
    const Sphere& sphere = spheres_[k];
    const double stiffness = model_.apical_springs[k].stiffness;
    for (std::size_t s = 0; s < shells.size(); ++s) {
      double of_shell = 0.0;
      for (std::uint32_t i = shells.first_node[s]; i < shells.first_node[s + 1]; ++i) {
        const double weight = sphere.weight[i];
        if (weight == 0.0) continue;
        const Vec3d from = x[i] - sphere.center;
        const double length = norm(from), off = length - sphere.radius;
        of_shell += weight * (0.5 * stiffness * off * off - dot(sphere.pull, from));
        force[i] += sphere.pull * weight;
        if (length > 0.0) force[i] -= from * (weight * stiffness * off / length);
      }
      if (of_shell != 0.0) energy.add(of_shell);
    }
  }
}

std::vector<SymMat3<double>> NodeTerms::stiffness(std::span<const Vec3d> x, std::size_t nodes) const {
  std::vector<SymMat3<double>> out;
  if (spheres_.empty()) return out;
  out.resize(nodes);
  for (std::size_t k = 0; k < spheres_.size(); ++k)
    for (std::size_t i = 0; i < nodes; ++i) {
      const Vec3d from = x[i] - spheres_[k].center;
      const double square = norm2(from);
      if (square > 0.0) out[i] += outer(model_.apical_springs[k].stiffness * spheres_[k].weight[i] / square, from);
    }
  return out;
}

}  // namespace morula
