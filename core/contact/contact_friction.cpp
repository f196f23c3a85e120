#include <algorithm>
#include <numeric>
#include <utility>

#include "core/contact/contact_layer.h"
#include "core/parallel/threads.h"

namespace morula {

FrictionPerArea ContactLayer::friction_of(std::span<const ContactBody> bodies, const SurfacePair& pair) const {
  const ContactBody& a = bodies[pair.a];
  if (pair.rigid) return material(a.material, obstacles_[pair.b].material).friction;
  const ContactBody& b = bodies[pair.b];
  if (a.shape == BodyShape::kSphere) return material(a.material, b.material).with_sphere;
  if (b.shape == BodyShape::kSphere) return material(b.material, a.material).with_sphere;
  return material(a.material, b.material).friction;
}

ObjectiveFriction ContactLayer::friction_now(const ContactScene& scene) const {
  ObjectiveFriction out;
  out.clear(scene.bodies, settings_.threads);
  for (const SurfacePair& pair : pairs_)
    out.add(pair, {view(scene, pair, 0), view(scene, pair, 1)}, scene, friction_of(scene.bodies, pair),
            FaceQuadrature::with_points(settings_.points_per_face));
  return out;
}

void ContactLayer::begin_step(const ContactScene& scene) {
  step_offsets_ = offsets_;
  for (SurfacePair& pair : pairs_) pair.step_overlap = pair.overlap;
  for (int kind = 0; kind < 2; ++kind) {  // all pairs of a kind are evaluated at once
    const auto& list = pairs_of_kind_[kind];
    if (list.empty() || pairs_[list.front()].at_start) continue;
    for (const std::uint32_t k : list) {
      SurfacePair& pair = pairs_[k];
      for (int d = 0; d < 2; ++d) pair.step_elements[d] = std::exchange(pair.elements[d], {});
      pair.at_start = true;
    }
    step_[kind] = std::exchange(present_[kind], {});
  }
  if (settings_.objective_friction) objective_ = friction_now(scene);
}

void ContactLayer::end_step() {
  for (int kind = 0; kind < 2; ++kind) {
    const auto& list = pairs_of_kind_[kind];
    if (!list.empty() && pairs_[list.front()].at_start) continue;
    for (const std::uint32_t k : list) pairs_[k].step_elements[0] = pairs_[k].step_elements[1] = {};
    step_[kind].clear();
  }
}

void ContactLayer::make_room() {
  for (SurfacePair& pair : pairs_) pair.elements[0] = pair.elements[1] = {};
  for (auto& stores : present_) stores.clear();
}

namespace {

/// A body's points in a friction sum; all null where it is an obstacle.
struct RubbingBody {
  const Topology* topology = nullptr;                 ///< null too: a sphere
  const Vec3d *position = nullptr, *start = nullptr;  ///< of its first point
  Vec3d* out = nullptr;                               ///< of its first point; null: not written

  RubbingBody() = default;
  RubbingBody(const ContactScene& scene, std::uint32_t number, std::span<const Vec3d> starts, std::span<Vec3d> outs, bool write)
      : topology(scene.topology_of(number)) {
    const std::uint32_t first = scene.bodies[number].first_point;
    position = scene.position.data() + first;
    start = starts.data() + first;
    if (write) out = outs.data() + first;
  }
  [[nodiscard]] PaddedVec3::Vector way(std::uint32_t node) const { return PaddedVec3::of(position[node]) - PaddedVec3::of(start[node]); }
};

/// Adds a·u + b (n·u) n of all points of one body against the other to their nodes and returns the sum of uᵀ(…)u; u is the jump of the
/// displacement. The points of a face come one after the other.
double rub(std::span<const ContactElement> elements, const FaceQuadrature& quadrature, const FrictionPerArea& friction,
           const RubbingBody& source, const RubbingBody& target, const Vec3d& rigid_displacement) {
  using Vector = PaddedVec3::Vector;
  const auto [normal, tangential] = friction;
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
        t = target.topology->faces()[e.target()];
        e.weights(mu);
        u -= target.way(t[0]) * mu[0] + target.way(t[1]) * mu[1] + target.way(t[2]) * mu[2];
      } else if (target.position != nullptr) {
        u -= target.way(0);
      }
      const Vector n = PaddedVec3::of(e.normal<double>());
      const double w = e.area();
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

std::vector<Vec3d> ContactLayer::obstacle_ways() const {
  std::vector<Vec3d> out(offsets_.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = offsets_[i] - step_offsets_[i];
  return out;
}

void ContactLayer::add_step_friction(const ContactScene& scene, std::span<const Vec3d> start, bool moved, std::span<Vec3d> out,
                                     OrderFreeSum& quadratic) const {
  const std::vector<Vec3d> obstacle_way = obstacle_ways();
  if (settings_.objective_friction) return objective_.rub(scene.position, start, obstacle_way, out, quadratic);
  const auto& quadrature = FaceQuadrature::with_points(settings_.points_per_face);
  const std::size_t threads = static_cast<std::size_t>(settings_.threads);
  std::vector<OrderFreeSum> sums(threads);
  // A thread writes a range of bodies and visits all pairs that touch it, in order: the bits do not depend on the number of threads.
  on_each_thread(settings_.threads, [&](std::size_t thread) {
    const auto has = [&](std::size_t body) { return body * threads / scene.bodies.size() == thread; };
    for (const SurfacePair& pair : pairs_) {
      if (!moved && !pair.rigid) continue;
      const ContactBody& a = scene.bodies[pair.a];
      const ContactBody* const b = pair.rigid ? nullptr : &scene.bodies[pair.b];
      const bool write[2] = {a.active() && has(pair.a), b != nullptr && b->active() && has(pair.b)};
      const bool count = a.owned && has(pair.a);
      if (!write[0] && !write[1] && !count) continue;
      const RubbingBody body[2] = {{scene, pair.a, start, out, write[0]},
                                   b == nullptr ? RubbingBody() : RubbingBody(scene, pair.b, start, out, write[1])};
      const Vec3d rigid = pair.rigid ? obstacle_way[pair.b] : Vec3d{};
      const FrictionPerArea friction = friction_of(scene.bodies, pair);
      double sum = 0.0;
      for (int d = 0; d < 2; ++d) sum += rub(pair.step_elements[d], quadrature, friction, body[d], body[1 - d], rigid);
      if (count) sums[thread].add(sum);
    }
  });
  for (const OrderFreeSum& sum : sums) quadratic += sum;
}

std::vector<ElementGroup> ContactLayer::element_groups(const ContactScene& scene) const {
  std::vector<ElementGroup> groups;
  groups.reserve(pairs_.size());
  // Pairs come by their first body; for each body, the order of its partners is the same in both.
  std::vector<std::uint32_t> order(pairs_.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto later = [&](std::uint32_t k) { return pairs_[k].rigid ? ~0u : scene.bodies[pairs_[k].b].place; };
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t k, std::uint32_t l) { return later(k) < later(l); });
  for (const std::uint32_t k : order) {
    const SurfacePair& pair = pairs_[k];
    if (pair.present(0).empty() && pair.present(1).empty()) continue;
    ElementGroup& group = groups.emplace_back();
    group.rigid = pair.rigid;
    if (pair.rigid) {
      group.obstacle = pair.b;
      group.topology[1] = obstacles_[pair.b].topology.get();
      group.position[1] = obstacles_[pair.b].position.data();
    }
    if (!settings_.objective_friction) {
      const auto [normal, tangential] = friction_of(scene.bodies, pair);
      group.normal_friction = static_cast<float>(normal);
      group.tangential_friction = static_cast<float>(tangential);
    }
    for (std::size_t side = 0; side < (pair.rigid ? 1 : 2); ++side) {
      const std::uint32_t number = side == 0 ? pair.a : pair.b;
      const ContactBody& body = scene.bodies[number];
      group.elements[side] = pair.present(side);
      group.topology[side] = scene.topology_of(number);
      group.body[side] = number;
      group.first[side] = body.first_point;
      group.position[side] = scene.position.data() + body.first_point;
      group.write[side] = body.active();
    }
  }
  return groups;
}

}  // namespace morula
