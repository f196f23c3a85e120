#include "core/contact/contact_layer.h"

namespace morula {

ObjectiveFriction ContactLayer::friction_now(const ContactScene& scene) const {
  ObjectiveFriction out;
  out.clear(scene.bodies, settings_.threads);
  for (const SurfacePair& pair : pairs_)
    out.add(pair, {view(scene, pair, 0), view(scene, pair, 1)}, scene, material_of(scene, pair),
            FaceQuadrature::with_points(settings_.points_per_face));
  return out;
}

void ContactLayer::begin_step(const ContactScene& scene) {
  step_offsets_ = offsets_;
  for (SurfacePair& pair : pairs_) {
    pair.step_overlap = pair.overlap;
    if (pair.at_start) continue;
    for (int d = 0; d < 2; ++d) std::swap(pair.step_elements[d], pair.elements[d]);
    pair.at_start = true;
  }
  if (settings_.objective_friction) objective_ = friction_now(scene);
}

namespace {

/// A body's points in a friction sum; all null where it is an obstacle.
struct RubbingBody {
  const Topology* topology = nullptr;                 ///< null too: a sphere
  const Vec3d *position = nullptr, *start = nullptr;  ///< of its first point
  Vec3d* out = nullptr;                               ///< of its first point; null: not written

  RubbingBody() = default;
  RubbingBody(const ContactScene& scene, std::uint32_t number, std::span<const Vec3d> starts, std::span<Vec3d> outs)
      : topology(scene.topology_of(number)) {
    const ContactBody& body = scene.bodies[number];
    position = scene.position.data() + body.first_point;
    start = starts.data() + body.first_point;
    if (body.active()) out = outs.data() + body.first_point;
  }
  [[nodiscard]] PaddedVec3::Vector way(std::uint32_t node) const { return PaddedVec3::of(position[node]) - PaddedVec3::of(start[node]); }
};

/// Adds a·u + b (n·u) n of all points of one body against the other to their nodes and returns the sum of uᵀ(…)u; u is the jump of the
/// displacement. The points of a face come one after the other.
double rub(std::span<const ContactElement> elements, const FaceQuadrature& quadrature, const ContactMaterial& contact,
           const RubbingBody& source, const RubbingBody& target, const Vec3d& rigid_displacement) {
  using Vector = PaddedVec3::Vector;
  const double normal = contact.normal_friction, tangential = contact.tangential_friction;
  const Vector rest = -PaddedVec3::of(rigid_displacement);
  const auto dot3 = [](Vector a, Vector b) {
    const Vector m = a * b;
    return m[0] + m[1] + m[2];
  };
  const auto add = [](Vec3d& to, Vector v) { to += Vec3d{v[0], v[1], v[2]}; };
  double sum = 0.0;
  for (std::size_t k = 0; k < elements.size();) {
    const std::uint32_t face = elements[k].source_face();
    const Triangle& s = source.topology->faces()[face];
    const Vector d[3] = {source.way(s[0]), source.way(s[1]), source.way(s[2])};
    Vector of_face[3] = {};
    for (; k < elements.size() && elements[k].source_face() == face; ++k) {
      const ContactElement& e = elements[k];
      const auto& beta = quadrature.weight[e.point()];
      Vector u = rest + d[0] * beta[0] + d[1] * beta[1] + d[2] * beta[2];
      Triangle t{0, 0, 0};
      double mu[3] = {1.0, 0.0, 0.0};
      if (target.topology != nullptr) {
        t = target.topology->faces()[e.target];
        e.weights(mu);
        u -= target.way(t[0]) * mu[0] + target.way(t[1]) * mu[1] + target.way(t[2]) * mu[2];
      } else if (target.position != nullptr) {
        u -= target.way(0);
      }
      const Vector n = PaddedVec3::of(e.normal<double>());
      const double w = e.w;
      const Vector f = u * (w * tangential) + n * (w * (normal - tangential) * dot3(n, u));
      for (std::size_t i = 0; i < 3; ++i) of_face[i] += f * beta[i];
      if (target.out != nullptr)
        for (std::size_t j = 0; j < 3; ++j)
          if (mu[j] != 0.0) add(target.out[t[j]], f * -mu[j]);
      sum += dot3(f, u);
    }
    if (source.out != nullptr)
      for (std::size_t i = 0; i < 3; ++i) add(source.out[s[i]], of_face[i]);
  }
  return sum;
}

}  // namespace

void ContactLayer::add_step_friction(const ContactScene& scene, std::span<const Vec3d> start, bool moved, std::span<Vec3d> out,
                                     OrderFreeSum& quadratic) const {
  if (settings_.objective_friction) {
    std::vector<Vec3d> way(offsets_.size());
    for (std::size_t i = 0; i < way.size(); ++i) way[i] = offsets_[i] - step_offsets_[i];
    return objective_.rub(scene.position, start, way, out, quadratic);
  }
  const auto& quadrature = FaceQuadrature::with_points(settings_.points_per_face);
  for (const SurfacePair& pair : pairs_) {
    if (!moved && !pair.rigid) continue;
    const RubbingBody body[2] = {{scene, pair.a, start, out}, pair.rigid ? RubbingBody() : RubbingBody(scene, pair.b, start, out)};
    const Vec3d rigid = pair.rigid ? offsets_[pair.b] - step_offsets_[pair.b] : Vec3d{};
    double sum = 0.0;
    for (int d = 0; d < 2; ++d) sum += rub(pair.step_elements[d], quadrature, material_of(scene, pair), body[d], body[1 - d], rigid);
    if (scene.bodies[pair.a].owned) quadratic.add(sum);
  }
}

std::vector<ElementGroup> ContactLayer::element_groups(const ContactScene& scene) const {
  std::vector<ElementGroup> groups;
  groups.reserve(pairs_.size());
  for (const SurfacePair& pair : pairs_) {
    if (pair.present(0).empty() && pair.present(1).empty()) continue;
    const ContactMaterial& contact = material_of(scene, pair);
    ElementGroup& group = groups.emplace_back();
    group.rigid = pair.rigid;
    if (!settings_.objective_friction) {
      group.normal_friction = static_cast<float>(contact.normal_friction);
      group.tangential_friction = static_cast<float>(contact.tangential_friction);
    }
    for (std::size_t side = 0; side < (pair.rigid ? 1 : 2); ++side) {
      const std::uint32_t number = side == 0 ? pair.a : pair.b;
      const ContactBody& body = scene.bodies[number];
      group.elements[side] = pair.present(side);
      group.topology[side] = scene.topology_of(number);
      group.body[side] = number;
      group.first[side] = body.first_point;
      group.write[side] = body.active();
    }
  }
  return groups;
}

}  // namespace morula
