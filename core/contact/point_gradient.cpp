#include "core/contact/point_gradient.h"

#include <cmath>

namespace morula {
namespace {

/// Forces on the corners of the source face from h = ∂E/∂n_T: F_c = e_c × w, w = (I − n_T n_Tᵀ) h/(2 A_T), e_c the edge opposite to c.
void add_face_normal_gradient(const PairBody& source, const SourceFace& face, const Vec3d& h, PointSink& sink) {
  const Vec3d& n = face.normal;
  const Vec3d w = (h - n * dot(n, h)) * (0.5 / face.area);
  const Vec3d& x0 = source.position[sink.source_node[0]];
  const Vec3d& x1 = source.position[sink.source_node[1]];
  const Vec3d& x2 = source.position[sink.source_node[2]];
  const Vec3d f0 = cross(x2 - x1, w), f1 = cross(x0 - x2, w);
  sink.source.force[sink.source_node[0]].v += PaddedVec3::of(f0);
  sink.source.force[sink.source_node[1]].v += PaddedVec3::of(f1);
  sink.source.force[sink.source_node[2]].v -= PaddedVec3::of(f0 + f1);
}

}  // namespace

void add_foot_gradient(const PointsEvaluation& e, std::size_t q, const Triangle& t, const PointGap& gap, const double (&c)[3],
                       PointSink& sink) {
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

void add_weight_gradient(const PointsEvaluation& e, std::size_t q, const SourceFace& face, const Triangle* t, const PointGap& gap,
                         const TargetNormal& normal, double h0, PointSink& sink) {
  add_face_normal_gradient(e.source, face, normal.unit * -h0, sink);
  const Vec3d h = face.normal * -h0;  // ∂E/∂n_y
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
    sink.target->has_node_normal = true;
    sink.target->node_normal[sink.target_node[j]] += across * gap.mu[j];
  }
  add_foot_gradient(e, q, *t, gap, c, sink);
}

}  // namespace morula
