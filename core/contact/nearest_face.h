#pragma once
#include "core/contact/surface_pair.h"

namespace morula {

/// Where a point stands against the other body.
struct PointGap {
  bool in_range = false;     ///< gap below the range, or inside
  double gap = 0.0;          ///< g: signed distance, < 0 inside [µm]
  Vec3d normal;              ///< n̂ = ∂g/∂x_q, unit, away from the target
  std::uint16_t place = 0;   ///< of the nearest face in the pair's target faces
  double mu[3] = {1, 0, 0};  ///< weights of its nodes at the nearest point
  Vec3d foot;                ///< the nearest point
};

/// Gap of a point against a sphere: |x_q − x| − R.
PointGap gap_to_sphere(const Vec3d& point, const PairBody& target, const ListReach& reach);

/// Gap of point number `index` of a direction against the nearest face of the target. Keeps what it found for later calls.
PointGap gap_to_surface(const Vec3d& point, std::size_t index, std::size_t source_face, const PointsEvaluation& evaluation,
                        PointsAgainstBody& lists);

}  // namespace morula
