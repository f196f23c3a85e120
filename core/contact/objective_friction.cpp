#include "core/contact/objective_friction.h"

#include <algorithm>
#include <cmath>

#include "core/parallel/threads.h"

namespace morula {
namespace {

/// Normal of a face, and (n × e_c)/(2A) of its corners, whose sum is zero to the last bit.
struct TurningFace {
  Vec3d normal, rate[3];

  TurningFace(const PairBody& body, const Triangle& t) {
    const Vec3d x[3] = {body.node(t[0]), body.node(t[1]), body.node(t[2])};
    const Vec3d twice = cross(x[1] - x[0], x[2] - x[0]);
    const double size = norm(twice);
    if (!(size > 0.0)) return;
    normal = twice * (1.0 / size);
    for (std::size_t c = 0; c < 3; ++c) rate[c] = cross(normal, x[(c + 2) % 3] - x[(c + 1) % 3]) * (1.0 / size);
  }
};

/// Rounded to a multiple of `unit`, a power of two: the sums of few such numbers are exact.
float in_units(double value, double unit) { return static_cast<float>(std::nearbyint(value / unit) * unit); }
constexpr double kWeightUnit = 0x1p-24;

/// Σ w_c = ±1 and Σ k_c = 0 to the last bit: contacts give no momentum to a pair.
void set_levers(ObjectiveElement& e, int first, const TurningFace& face, double size) {
  e.normal[first == 0 ? 0 : 1] = to_float(face.normal);
  double most = 0.0;
  for (const Vec3d& rate : face.rate) most = std::max({most, std::abs(rate.x), std::abs(rate.y), std::abs(rate.z)});
  const double unit = std::ldexp(1.0, std::ilogb(std::max(std::abs(size) * most, 1e-30)) - 22);
  const auto rounded = [&](const Vec3d& k) { return Vec3f{in_units(k.x, unit), in_units(k.y, unit), in_units(k.z, unit)}; };
  const Vec3f a = rounded(face.rate[0] * size), b = rounded(face.rate[1] * size);
  e.lever[first] = a;
  e.lever[first + 1] = b;
  e.lever[first + 2] = Vec3f{} - a - b;
}

}  // namespace

void ObjectiveFriction::add(const SurfacePair& pair, const PairBody (&body)[2], const ContactScene& scene, const FrictionPerArea& friction,
                            const FaceQuadrature& quadrature) {
  const auto tangential = static_cast<float>(friction.tangential);
  const auto more = static_cast<float>(friction.normal - friction.tangential);
  const std::uint32_t number[2] = {pair.a, pair.b};
  const std::size_t begin = elements_.size();
  for (std::size_t d = 0; d < (pair.rigid ? 1 : 2); ++d) {
    const PairBody &source = body[d], &target = body[1 - d];
    for (const ContactElement& given : pair.present(d)) {
      ObjectiveElement& e = elements_.emplace_back();
      e = {};
      e.body[0] = number[d];
      e.body[1] = number[1 - d];
      e.n = given.normal<float>();
      e.across = given.area() * tangential;
      e.along = given.area() * more;
      const Triangle& s = source.topology->faces()[given.source_face()];
      const std::uint32_t first_source = scene.bodies[number[d]].first_point;
      Vec3d apart;  // x − y
      for (std::size_t c = 0; c < 3; ++c) {
        e.point[c] = first_source + s[c];
        e.weight[c] = in_units(quadrature.weight[given.point()][c], kWeightUnit);
        apart += source.node(s[c]) * quadrature.weight[given.point()][c];
      }
      e.weight[2] = 1.0f - e.weight[0] - e.weight[1];
      e.count = 3;
      const std::uint32_t first_target = pair.rigid ? 0 : scene.bodies[number[1 - d]].first_point;
      if (target.topology == nullptr) {
        e.point[3] = first_target;
        e.weight[3] = -1.0f;
        e.count = 4;
        continue;
      }
      const Triangle& t = target.topology->faces()[given.target()];
      double mu[3];
      given.weights(mu);
      for (std::size_t j = 0; j < 3; ++j) apart -= target.node(t[j]) * mu[j];
      const double gap = dot(apart, given.normal<double>());
      set_levers(e, 0, TurningFace(source, s), -0.5 * gap);  // +½ g ṅ_A
      if (pair.rigid) continue;
      for (std::size_t j = 0; j < 3; ++j) e.point[3 + j] = first_target + t[j];
      e.weight[3] = in_units(-mu[0], kWeightUnit);
      e.weight[4] = in_units(-mu[1], kWeightUnit);
      e.weight[5] = -1.0f - e.weight[3] - e.weight[4];
      e.count = 6;
      set_levers(e, 3, TurningFace(target, t), 0.5 * gap);  // −½ g ṅ_B
    }
  }
  if (elements_.size() > begin)
    pairs_.push_back({begin, elements_.size(), scene.bodies[pair.a].owned, pair.rigid, pair.rigid ? pair.b : 0});
}

void ObjectiveFriction::rub(std::span<const Vec3d> position, std::span<const Vec3d> start, std::span<const Vec3d> obstacle_way,
                            std::span<Vec3d> out, OrderFreeSum& quadratic) const {
  for (const Pair& pair : pairs_) {
    double sum = 0.0;
    for (std::size_t k = pair.begin; k < pair.end; ++k) {
      const ObjectiveElement& e = elements_[k];
      Vec3d u = e.jump([&](std::uint32_t i) { return position[i] - start[i]; });
      if (pair.rigid) u -= obstacle_way[pair.obstacle];
      const Vec3d f = e.drag(u);
      for (int c = 0; c < e.count; ++c)
        if (bodies_[e.body[c < 3 ? 0 : 1]].active()) out[e.point[c]] += e.share(c, f);
      sum += dot(f, u);
    }
    if (pair.counts) quadratic.add(sum);
  }
}

template <class F>
void ObjectiveFriction::for_corners(F&& function) const {
  const auto threads = static_cast<std::uint32_t>(threads_);
  on_each_thread(threads_, [&](std::size_t thread) {
    for (const ObjectiveElement& e : elements_) {
      const bool mine[2] = {e.body[0] % threads == thread && bodies_[e.body[0]].active(),
                            e.count > 3 && e.body[1] % threads == thread && bodies_[e.body[1]].active()};
      if (!mine[0] && !mine[1]) continue;
      function(e, mine);
    }
  });
}

void ObjectiveFriction::add_product(std::span<const Float4> p, std::span<Float4> q) const {
  for_corners([&](const ObjectiveElement& e, const bool(&mine)[2]) {
    const Vec3f u = e.jump([&](std::uint32_t i) { return Vec3f{p[i].x, p[i].y, p[i].z}; });
    const Vec3f f = e.drag(u);
    for (int c = 0; c < e.count; ++c) {
      if (!mine[c < 3 ? 0 : 1]) continue;
      const Vec3f share = e.share(c, f);
      Float4& to = q[e.point[c]];
      to = {to.x + share.x, to.y + share.y, to.z + share.z, 0.0f};
    }
  });
}

void ObjectiveFriction::add_diagonal(std::span<SymMat3<float>> diagonal) const {
  for_corners([&](const ObjectiveElement& e, const bool(&mine)[2]) {
    for (int c = 0; c < e.count; ++c) {
      if (!mine[c < 3 ? 0 : 1]) continue;
      // J_cᵀ D J_c column by column
      Vec3f column[3];
      for (int axis = 0; axis < 3; ++axis) {
        Vec3f unit{};
        unit[static_cast<std::size_t>(axis)] = 1.0f;
        const Vec3f& m = e.normal[c < 3 ? 0 : 1];
        column[axis] = e.share(c, e.drag(unit * e.weight[c] + e.lever[c] * m[static_cast<std::size_t>(axis)]));
      }
      diagonal[e.point[c]] += SymMat3<float>{column[0].x, column[0].y, column[0].z, column[1].y, column[1].z, column[2].z};
    }
  });
}

}  // namespace morula
