#pragma once
#include "core/contact/surface_pair.h"

namespace morula {

/// Where a point stands against the other body.
struct PointGap {
  double gap = 0.0;          ///< g: signed distance, < 0 inside [µm]
  Vec3d normal;              ///< n̂ = ∂g/∂x_q, unit, away from the target
  double mu[3] = {1, 0, 0};  ///< weights of the nearest face's nodes at the nearest point
};

/// Where the results of one point go.
struct PointSink {
  PairGradient& source;
  PairGradient* target;  ///< null for rigid obstacles
  const Triangle& source_node;
  Triangle target_node;

  void push_source(const FaceQuadrature& quadrature, std::size_t q, const Vec3d& force) {
    const auto padded = PaddedVec3::of(force);
    for (std::size_t i = 0; i < 3; ++i) source.force[source_node[i]].v += padded * quadrature.weight[q][i];
  }
  void push_target(std::size_t corner, const Vec3d& force) {
    if (target != nullptr) target->force[target_node[corner]].v += PaddedVec3::of(force);
  }
  void push_target(const double (&mu)[3], const Vec3d& force) {
    if (target == nullptr) return;
    const auto padded = PaddedVec3::of(force);
    for (std::size_t j = 0; j < 3; ++j) target->force[target_node[j]].v += padded * mu[j];
  }
};

/// Normal of the target at the foot point: node normals interpolated, or the sphere's.
struct TargetNormal {
  Vec3d unit;
  double length;  ///< of the interpolated vector
};

/// Face that a point lies on.
struct SourceFace {
  Vec3d normal;  ///< n_T
  double area;   ///< A_T
};

/// Gradient through the weights μ_j of the foot point, which slides on its feature: c_j = ∂E/∂μ_j.
void add_foot_gradient(const PointsEvaluation& evaluation, std::size_t q, const Triangle& target, const PointGap& gap, const double (&c)[3],
                       PointSink& sink);

/// Gradient through the opposed-normal weight: `h0` = ∂E/∂m with m = −n_T·n_y. `target`: the nearest face; null: a sphere.
void add_weight_gradient(const PointsEvaluation& evaluation, std::size_t q, const SourceFace& face, const Triangle* target,
                         const PointGap& gap, const TargetNormal& normal, double h0, PointSink& sink);

}  // namespace morula
