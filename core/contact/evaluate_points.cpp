#include <cmath>

#include "core/contact/nearest_face.h"
#include "core/contact/surface_pair.h"

namespace morula {
namespace {

/// Where the results of one direction go.
struct Sink {
  PairGradient& source;
  PairGradient* target;  ///< null for rigid obstacles
  const std::array<std::uint16_t, 3>& source_node;
  std::array<std::uint16_t, 3> target_node;

  void push_source(const FaceQuadrature& quadrature, int q, const Vec3d& force) {
    for (std::size_t i = 0; i < 3; ++i) source.force[source_node[i]] += force * quadrature.weight[q][i];
  }
  void push_target(std::size_t corner, const Vec3d& force) {
    if (target != nullptr) target->force[target_node[corner]] += force;
  }
};

void grow(std::vector<Vec3d>& gradient, std::size_t size) {
  if (gradient.empty()) gradient.assign(size, Vec3d{});
}

/// Normal of the target at the foot point: node normals interpolated, or the sphere's.
struct TargetNormal {
  Vec3d unit;
  double length;  ///< of the interpolated vector
};

TargetNormal target_normal(const PairBody& target, const Triangle* t, const PointGap& gap) {
  if (t == nullptr) return {gap.normal, 1.0};
  const Vec3d sum =
      target.node_normal[(*t)[0]] * gap.mu[0] + target.node_normal[(*t)[1]] * gap.mu[1] + target.node_normal[(*t)[2]] * gap.mu[2];
  const double length = norm(sum);
  if (length < 1e-9) return {gap.normal, 1.0};
  return {sum * (1.0 / length), length};
}

/// Gradient through the weights μ_j of the foot point, which slides on its feature: c_j = ∂E/∂μ_j.
void add_foot_gradient(const PointsEvaluation& e, int q, const Triangle& t, const PointGap& gap, const double (&c)[3], Sink& sink) {
  const Vec3d y[3] = {e.target.node(t[0]), e.target.node(t[1]), e.target.node(t[2])};
  const int zeros = (gap.mu[0] == 0.0) + (gap.mu[1] == 0.0) + (gap.mu[2] == 0.0);
  if (zeros == 0) {  // inside the face: ∂λ_j is the in-plane gradient, plus the tilt of the plane
    const Vec3d normal = cross(y[1] - y[0], y[2] - y[0]);
    const double twice_area = norm(normal);
    const Vec3d n = normal * (1.0 / twice_area);
    Vec3d slope[3], total;
    for (std::size_t j = 0; j < 3; ++j) {
      slope[j] = cross(n, y[(j + 2) % 3] - y[(j + 1) % 3]) * (1.0 / twice_area);
      total += slope[j] * c[j];
    }
    sink.push_source(e.quadrature, q, -total);
    for (std::size_t j = 0; j < 3; ++j) sink.push_target(j, total * gap.mu[j] - n * (gap.gap * dot(slope[j], total)));
  } else if (zeros == 1) {  // on an edge p–r: ∂t is along the edge, plus its turn
    const std::size_t p = gap.mu[0] == 0.0 ? 1 : gap.mu[1] == 0.0 ? 2 : 0;
    const std::size_t r = (p + 1) % 3;
    const Vec3d along = y[r] - y[p];
    const double length2 = norm2(along);
    const double k = c[r] - c[p];
    const Vec3d pull = along * (k / length2);
    const Vec3d turn = (gap.normal * gap.gap) * (k / length2);
    sink.push_source(e.quadrature, q, -pull);
    sink.push_target(p, pull * gap.mu[p] + turn);
    sink.push_target(r, pull * gap.mu[r] - turn);
  }
}

/// Gradient through the opposed-normal weight: `h0` = ∂E/∂m with m = −n_T·n_y.
void add_weight_gradient(const PointsEvaluation& e, int q, std::uint32_t face, std::size_t source_place, const Triangle* t,
                         const PointGap& gap, const TargetNormal& normal, double h0, Sink& sink) {
  grow(sink.source.face_normal, sink.source.face_energy.size());
  sink.source.face_normal[source_place] -= normal.unit * h0;
  const Vec3d h = e.source.face_normal[face] * -h0;  // ∂E/∂n_y
  const Vec3d across = (h - normal.unit * dot(normal.unit, h)) * (1.0 / normal.length);
  if (t == nullptr) {  // n_y = (x_q − x)/|x_q − x| of a sphere
    const Vec3d force = across * (1.0 / (gap.gap + e.target.radius));
    sink.push_source(e.quadrature, q, -force);
    sink.push_target(0, force);
    return;
  }
  double c[3];
  for (std::size_t j = 0; j < 3; ++j) {
    c[j] = dot(across, e.target.node_normal[(*t)[j]]);
    if (sink.target == nullptr || gap.mu[j] == 0.0) continue;
    grow(sink.target->node_normal, sink.target->node.size());
    sink.target->node_normal[sink.target_node[j]] += across * gap.mu[j];
  }
  add_foot_gradient(e, q, *t, gap, c, sink);
}

ContactElement element_of(std::uint32_t source_face, std::uint32_t target_face, int q, const PointGap& gap, double area,
                          double stiffness, double range) {
  ContactElement element{};
  element.source = 4 * source_face + static_cast<std::uint32_t>(q);
  element.target = target_face;
  element.set_weights(gap.mu[0], gap.mu[1]);
  element.set_normal(gap.normal);
  element.w = static_cast<float>(area * friction_weight(gap.gap, range));
  element.k = static_cast<float>(area * stiffness);
  return element;
}

/// Share of a point's area that counts as contact area: 1 up to c/2, falling linearly to 0 at c.
double contact_ramp(double gap, double range) {
  const double t = (range - gap) / (0.5 * range);
  return t > 1.0 ? 1.0 : t < 0.0 ? 0.0 : t;
}

}  // namespace

void evaluate_points(const PointsEvaluation& given, int d, SurfacePair& pair) {
  PointsAgainstBody& lists = pair.points[d];
  const bool sphere = given.target.topology == nullptr;
  std::vector<Vec3d> centroid(lists.target_face.size());
  for (std::size_t m = 0; m < centroid.size(); ++m) centroid[m] = given.target.centroid(lists.target_face[m]);
  PointsEvaluation e = given;
  e.target_centroid = centroid;
  const double part = 1.0 / e.quadrature.count;
  std::size_t index = 0;
  for (std::size_t k = 0; k < lists.source_face.size(); ++k) {
    const std::uint32_t face = lists.source_face[k];
    const Triangle& t = e.source.topology->faces()[face];
    const Vec3d corner[3] = {e.source.node(t[0]), e.source.node(t[1]), e.source.node(t[2])};
    Sink sink{pair.gradient[d], e.target_moves ? &pair.gradient[1 - d] : nullptr, lists.source_node[k], {0, 0, 0}};
    for (int q = 0; q < e.quadrature.count; ++q, ++index) {
      const auto& beta = e.quadrature.weight[q];
      const Vec3d point = corner[0] * beta[0] + corner[1] * beta[1] + corner[2] * beta[2];
      const PointGap gap = sphere ? gap_to_sphere(point, e.target, e.reach) : gap_to_surface(point, index, k, e, lists);
      if (!gap.in_range) continue;

      const Triangle* target_face = sphere ? nullptr : &e.target.topology->faces()[lists.target_face[gap.place]];
      if (!sphere && e.target_moves) sink.target_node = lists.target_node[gap.place];
      const TargetNormal normal = target_normal(e.target, target_face, gap);
      const auto weight = OpposedWeight::of(-dot(e.source.face_normal[face], normal.unit));
      const auto attraction = e.material.law.attraction(gap.gap);
      const auto repulsion = e.material.law.repulse(gap.gap);

      const double scale = e.share * part;
      const double area = scale * e.source.face_area[face];
      const double density = weight.value * attraction.energy + repulsion.energy;
      pair.energy += area * density;
      sink.source.face_energy[k] += scale * density;
      sink.source.face_contact[k] += part * e.source.face_area[face] * contact_ramp(gap.gap, e.material.law.range);
      pair.overlap = gap.gap < -pair.overlap ? -gap.gap : pair.overlap;

      const Vec3d pull = gap.normal * (area * (weight.value * attraction.slope + repulsion.slope));
      sink.push_source(e.quadrature, q, -pull);
      if (sphere)
        sink.push_target(0, pull);
      else
        for (std::size_t j = 0; j < 3; ++j) sink.push_target(j, pull * gap.mu[j]);
      if (weight.slope != 0.0) add_weight_gradient(e, q, face, k, target_face, gap, normal, area * weight.slope * attraction.energy, sink);
      pair.elements[d].push_back(
          element_of(face, sphere ? 0 : lists.target_face[gap.place], q, gap, area,
                     weight.value * attraction.curvature + repulsion.curvature, e.material.law.range));
    }
  }
}

}  // namespace morula
