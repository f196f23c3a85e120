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
  std::span<const Vec3d> displacement;
  std::span<Vec3d> out;
  std::uint32_t source_first, target_first;
  bool write_source, write_target, target_moves;
  Vec3d rigid_displacement;

  double operator()(const ContactElement& e) const {
    const auto& beta = quadrature.weight[e.point];
    const double mu[3] = {e.mu[0], e.mu[1], 1.0 - e.mu[0] - e.mu[1]};
    Vec3d u = -rigid_displacement;
    for (std::size_t i = 0; i < 3; ++i) u += displacement[source_first + e.source[i]] * beta[i];
    if (target_moves)
      for (std::size_t j = 0; j < 3; ++j) u -= displacement[target_first + e.target[j]] * mu[j];
    const Vec3d n{e.n[0], e.n[1], e.n[2]};
    const Vec3d f = u * static_cast<double>(e.a) + n * (static_cast<double>(e.b) * dot(n, u));
    if (write_source)
      for (std::size_t i = 0; i < 3; ++i) out[source_first + e.source[i]] += f * beta[i];
    if (write_target)
      for (std::size_t j = 0; j < 3; ++j) out[target_first + e.target[j]] -= f * mu[j];
    return dot(f, u);
  }
};

}  // namespace

void ContactLayer::add_step_friction(const ContactScene& scene, std::span<const Vec3d> displacement, std::span<Vec3d> out,
                                     OrderFreeSum& quadratic) const {
  const auto& quadrature = FaceQuadrature::with_points(settings_.points_per_face);
  for (const SurfacePair& pair : pairs_) {
    double sum = 0.0;
    for (int d = 0; d < 2; ++d) {
      const ContactBody& a = scene.bodies[pair.a];
      const ContactBody* b = pair.rigid ? nullptr : &scene.bodies[pair.b];
      const ContactBody* source = d == 0 ? &a : b;
      const ContactBody* target = d == 0 ? b : &a;
      if (source == nullptr) continue;
      const FrictionScatter scatter{quadrature,
                                    displacement,
                                    out,
                                    source->first_point,
                                    target != nullptr ? target->first_point : 0,
                                    source->active(),
                                    target != nullptr && target->active(),
                                    target != nullptr,
                                    pair.rigid ? offsets_[pair.b] - step_offsets_[pair.b] : Vec3d{}};
      for (const ContactElement& e : pair.step_elements[d]) sum += scatter(e);
    }
    if (scene.bodies[pair.a].owned) quadratic.add(sum);
  }
}

std::vector<ElementGroup> ContactLayer::element_groups(const ContactScene& scene) const {
  std::vector<ElementGroup> groups;
  groups.reserve(2 * pairs_.size());
  for (const SurfacePair& pair : pairs_) {
    const ContactBody& a = scene.bodies[pair.a];
    for (int d = 0; d < 2; ++d) {
      if (pair.elements[d].empty()) continue;
      if (pair.rigid) {
        groups.push_back({pair.elements[d], pair.a, pair.a, a.first_point, 0, a.active(), false, false});
        continue;
      }
      const ContactBody& b = scene.bodies[pair.b];
      const ContactBody& source = d == 0 ? a : b;
      const ContactBody& target = d == 0 ? b : a;
      groups.push_back({pair.elements[d], d == 0 ? pair.a : pair.b, d == 0 ? pair.b : pair.a, source.first_point, target.first_point,
                        source.active(), target.active(), true});
    }
  }
  return groups;
}

}  // namespace morula
