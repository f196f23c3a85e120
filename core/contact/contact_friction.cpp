#include "core/contact/contact_layer.h"

namespace morula {

void ContactLayer::begin_step() {
  step_offsets_ = offsets_;
  for (SurfacePair& pair : pairs_)
    for (int d = 0; d < 2; ++d) pair.step_elements[d] = pair.elements[d];
}

namespace {

/// Adds a·u + b (n·u) n of one element to its points' sums and returns uᵀ(…)u; u is the jump of the displacement.
struct FrictionScatter {
  const FaceQuadrature& quadrature;
  std::span<const Vec3d> position, start;
  std::span<Vec3d> out;
  const ContactBody& source;
  const ContactBody* target;  ///< null: an obstacle
  double normal_friction, tangential_friction;
  Vec3d rigid_displacement;

  Vec3d way(std::uint32_t point) const { return position[point] - start[point]; }

  double operator()(const ContactElement& e) const {
    const Triangle& s = source.topology->faces()[e.source_face()];
    const auto& beta = quadrature.weight[e.point()];
    Vec3d u = -rigid_displacement;
    for (std::size_t i = 0; i < 3; ++i) u += way(source.first_point + s[i]) * beta[i];
    Triangle t{0, 0, 0};
    double mu[3] = {1.0, 0.0, 0.0};
    if (target != nullptr) {
      if (target->topology != nullptr) {
        t = target->topology->faces()[e.target];
        e.weights(mu);
      }
      for (std::size_t j = 0; j < 3; ++j) u -= way(target->first_point + t[j]) * mu[j];
    }
    const Vec3d n = e.normal<double>();
    const double w = e.w;
    const Vec3d f = u * (w * tangential_friction) + n * (w * (normal_friction - tangential_friction) * dot(n, u));
    if (source.active())
      for (std::size_t i = 0; i < 3; ++i) out[source.first_point + s[i]] += f * beta[i];
    if (target != nullptr && target->active())
      for (std::size_t j = 0; j < 3; ++j) out[target->first_point + t[j]] -= f * mu[j];
    return dot(f, u);
  }
};

}  // namespace

void ContactLayer::add_step_friction(const ContactScene& scene, std::span<const Vec3d> start, bool moved, std::span<Vec3d> out,
                                     OrderFreeSum& quadratic) const {
  const auto& quadrature = FaceQuadrature::with_points(settings_.points_per_face);
  for (const SurfacePair& pair : pairs_) {
    if (!moved && !pair.rigid) continue;
    double sum = 0.0;
    for (int d = 0; d < 2; ++d) {
      const ContactBody& a = scene.bodies[pair.a];
      const ContactBody* b = pair.rigid ? nullptr : &scene.bodies[pair.b];
      const ContactBody* source = d == 0 ? &a : b;
      const ContactBody* target = d == 0 ? b : &a;
      if (source == nullptr) continue;
      const ContactMaterial& contact = material_of(scene, pair);
      const FrictionScatter scatter{quadrature,
                                    scene.position,
                                    start,
                                    out,
                                    *source,
                                    target,
                                    contact.normal_friction,
                                    contact.tangential_friction,
                                    pair.rigid ? offsets_[pair.b] - step_offsets_[pair.b] : Vec3d{}};
      for (const ContactElement& e : pair.step_elements[d]) sum += scatter(e);
    }
    if (scene.bodies[pair.a].owned) quadratic.add(sum);
  }
}

std::vector<ElementGroup> ContactLayer::element_groups(const ContactScene& scene) const {
  std::vector<ElementGroup> groups;
  groups.reserve(pairs_.size());
  for (const SurfacePair& pair : pairs_) {
    if (pair.elements[0].empty() && pair.elements[1].empty()) continue;
    const ContactMaterial& contact = material_of(scene, pair);
    ElementGroup& group = groups.emplace_back();
    group.rigid = pair.rigid;
    group.normal_friction = static_cast<float>(contact.normal_friction);
    group.tangential_friction = static_cast<float>(contact.tangential_friction);
    for (std::size_t side = 0; side < (pair.rigid ? 1 : 2); ++side) {
      const std::uint32_t number = side == 0 ? pair.a : pair.b;
      const ContactBody& body = scene.bodies[number];
      group.elements[side] = pair.elements[side];
      group.topology[side] = body.topology;
      group.body[side] = number;
      group.first[side] = body.first_point;
      group.write[side] = body.active();
    }
  }
  return groups;
}

}  // namespace morula
