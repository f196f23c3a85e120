#include "core/contact/point_batch.h"

#include <cmath>

#include "core/contact/closest_foot.h"
#include "core/contact/nearest_face.h"

namespace morula {
namespace {

constexpr int kLanes = PointBatch::kLanes;
using Real = PointBatch::Real;
using Vector = Vec3<Real>;

/// What is behind the point is cut off.
void store_cut(std::int32_t (&out)[kLanes], Real value) {
  using Int [[gnu::vector_size(kLanes * sizeof(std::int32_t))]] = std::int32_t;
  const Int cut = __builtin_convertvector(value.v, Int);
  __builtin_memcpy(out, &cut, sizeof cut);
}

/// W of a face with these marks of body d against the faces around a node of the other, on average: it changes without a jump as the nearest
/// point moves on.
double adhesion_at_node(const PointsEvaluation& e, int d, std::uint8_t marks, std::uint32_t node) {
  const auto faces = e.target.topology->faces_of_node(node);
  double sum = 0.0;
  for (const std::uint32_t face : faces) {
    const std::uint8_t other = e.target.marks(face);
    sum += d == 0 ? e.material.regional->between(marks, other) : e.material.regional->between(other, marks);
  }
  return sum / static_cast<double>(faces.size());
}

}  // namespace

void gaps_to_faces(const PointsEvaluation& e, std::span<const std::uint32_t> face, PointBatch& batch) {
  const Vector point = load(batch.point), a = load(batch.corner[0]), b = load(batch.corner[1]), c = load(batch.corner[2]);
  Foot<Real> foot = closest_foot<Real>(point, a, b, c);
  for (int lane = 0; lane < kLanes; ++lane) {
    if (foot.doubtful[lane] == 0.0) continue;
    const auto right =
        closest_foot_of(get(batch.point, lane), get(batch.corner[0], lane), get(batch.corner[1], lane), get(batch.corner[2], lane));
    foot.away.x.set(lane, right.away.x), foot.away.y.set(lane, right.away.y), foot.away.z.set(lane, right.away.z);
    for (int k = 0; k < 3; ++k) foot.mu[k].set(lane, right.mu[k]);
    foot.distance2.set(lane, right.distance2);
  }
  const Vector twice_area = cross(b - a, c - a);
  const Vector unit = twice_area * (Real(1.0) / norm(twice_area));
  const Real distance = sqrt(foot.distance2), zero(0.0);
  select(dot(foot.away, unit) < zero, -distance, distance).store(batch.gap);
  store(batch.normal, unit);
  for (std::size_t k = 0; k < 3; ++k) foot.mu[k].store(batch.mu[k]);
  const Real inner = min(min(foot.mu[0], foot.mu[1]), foot.mu[2]);
  for (int lane = 0; lane < kLanes; ++lane) {
    if (inner[lane] != 0.0) continue;  // on an edge or a node: the side is that of the pseudonormal
    const Vec3d away{foot.away.x[lane], foot.away.y[lane], foot.away.z[lane]};
    const double mu[3] = {foot.mu[0][lane], foot.mu[1][lane], foot.mu[2][lane]};
    const bool inside = is_inside(away, e.target, face[static_cast<std::size_t>(lane)], mu);
    batch.gap[lane] = inside ? -distance[lane] : distance[lane];
    if (distance[lane] >= 1e-12) put(batch.normal, lane, away * ((inside ? -1.0 : 1.0) / distance[lane]));
  }
  const Vector sum =
      load(batch.node_normal[0]) * foot.mu[0] + load(batch.node_normal[1]) * foot.mu[1] + load(batch.node_normal[2]) * foot.mu[2];
  const Real length = norm(sum);
  const auto usable = length > Real(1e-9);
  const Vector normal = load(batch.normal);
  const Real inverse = Real(1.0) / length;
  store(batch.unit, Vector{select(usable, sum.x * inverse, normal.x), select(usable, sum.y * inverse, normal.y),
                           select(usable, sum.z * inverse, normal.z)});
  select(usable, length, Real(1.0)).store(batch.length);
}

void gaps_to_sphere(const PairBody& target, PointBatch& batch) {
  const Vec3d center = target.node(0);
  for (int lane = 0; lane < kLanes; ++lane) {
    const Vec3d away = get(batch.point, lane) - center;
    const double distance = norm(away);
    batch.gap[lane] = distance - target.radius;
    const Vec3d normal = distance > 1e-12 ? away * (1.0 / distance) : Vec3d{0, 0, 1};
    put(batch.normal, lane, normal);
    put(batch.unit, lane, normal);
    batch.length[lane] = 1.0;
    batch.mu[0][lane] = 1.0;
    batch.mu[1][lane] = batch.mu[2][lane] = 0.0;
  }
}

void find_adhesion(const PointsEvaluation& e, int d, std::uint8_t marks, const Triangle* face, int lane, PointBatch& batch) {
  for (std::size_t j = 0; j < 3; ++j)
    batch.corner_adhesion[j][lane] = face != nullptr && !e.target.mark.empty() ? adhesion_at_node(e, d, marks, (*face)[j])
                                     : d == 0                                  ? e.material.regional->between(marks, 0)
                                                                               : e.material.regional->between(0, marks);
}

void take_distances(double touch, PointBatch& batch) {
  for (int lane = 0; lane < kLanes; ++lane) {
    if (batch.inside[lane]) put(batch.normal, lane, -get(batch.normal, lane));
    batch.gap[lane] = std::abs(batch.gap[lane]) - touch;
  }
}

template <bool kPlain>
void respond(const PointsEvaluation& e, int points, PointBatch& batch) {
  const TractionLaw& law = e.material.law;
  const Vector x0 = load(batch.source_corner[0]);
  const Vector twice = cross(load(batch.source_corner[1]) - x0, load(batch.source_corner[2]) - x0);
  const Real length = norm(twice), face_area = length * Real(0.5);
  const Vector source_normal = twice * (Real(1.0) / length);
  store(batch.source_normal, source_normal);
  face_area.store(batch.face_area);
  const Real gap = Real::load(batch.gap);
  const auto weight = OpposedWeight::of(-dot(source_normal, load(batch.unit)));
  auto attraction = law.attraction(gap);
  const auto repulsion = law.repulse(gap);
  const Real part(1.0 / points);
  const Real area = face_area * Real(e.share) * part;
  if (!kPlain && e.material.regional) {
    (area * weight.value * attraction.energy).store(batch.per_adhesion);
    Real adhesion(0.0);
    for (std::size_t j = 0; j < 3; ++j) adhesion = adhesion + Real::load(batch.corner_adhesion[j]) * Real::load(batch.mu[j]);
    attraction = {attraction.energy * adhesion, attraction.slope * adhesion, attraction.curvature * adhesion};
  }
  weight.slope.store(batch.weight_slope);
  (area * attraction.energy).store(batch.attraction);
  (weight.value * attraction.energy + repulsion.energy).store(batch.density);
  (face_area * part * contact_share(gap, law.range)).store(batch.told);
  store(batch.pull, load(batch.normal) * (area * (weight.value * attraction.slope + repulsion.slope)));
  (area * friction_weight(gap, law.range)).store(batch.bearing);
  (area * (weight.value * attraction.curvature + repulsion.curvature)).store(batch.stiffness);
  area.store(batch.area);
  for (std::size_t k = 0; k < 2; ++k)
    store_cut(batch.rounded_mu[k], Real::load(batch.mu[k]) * Real(ContactElement::kWeightUnits) + Real(0.5));
}

template void respond<true>(const PointsEvaluation&, int, PointBatch&);
template void respond<false>(const PointsEvaluation&, int, PointBatch&);

}  // namespace morula
