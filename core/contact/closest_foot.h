#pragma once
#include "core/mesh/closest_point.h"
#include "core/simd/lane.h"
#include "core/vec3.h"

namespace morula {

/// Nearest points of triangles, for one point and triangle (Real = double) or for a lane of them, with the same bits.
template <class Real>
struct Foot {
  Vec3<Real> away;  ///< point − nearest point
  Real mu[3];       ///< weights of the corners; on an edge exactly one is zero, at a corner two
  Real distance2;
  Real doubtful;  ///< 1 where rounding leaves the region open (slivers): ask closest_point_on_triangle()
};

/// The regions of closest_point_on_triangle() by selection instead of branches.
template <class Real>
Foot<Real> closest_foot(const Vec3<Real>& p, const Vec3<Real>& a, const Vec3<Real>& b, const Vec3<Real>& c) {
  const Real zero(0.0), one(1.0);
  const Vec3<Real> ab = b - a, ac = c - a, ap = p - a;
  const Real ab_ab = dot(ab, ab), ab_ac = dot(ab, ac), ac_ac = dot(ac, ac);
  const Real longest2 = max(max(ab_ab, ac_ac), ab_ab - Real(2.0) * ab_ac + ac_ac);
  const Real d1 = dot(ab, ap), d2 = dot(ac, ap);
  const Real d3 = d1 - ab_ab, d4 = d2 - ab_ac, d5 = d1 - ab_ac, d6 = d2 - ac_ac;
  const Real area_a = d3 * d6 - d5 * d4, area_b = d5 * d2 - d1 * d6, area_c = d1 * d4 - d3 * d2;

  const Real scale = one / (area_a + area_b + area_c);
  Real u = area_a * scale, v = area_b * scale, w = area_c * scale;
  Real doubtful = select(u <= zero, one, select(v <= zero, one, select(w <= zero, one, zero)));
  const auto take = [&](auto mask, Real mu0, Real mu1, Real mu2) {
    u = select(mask, mu0, u);
    v = select(mask, mu1, v);
    w = select(mask, mu2, w);
    doubtful = select(mask, zero, doubtful);
  };
  const Real e43 = d4 - d3, e56 = d5 - d6;
  const Real along_bc = e43 / (e43 + e56), along_ac = d2 / (d2 - d6), along_ab = d1 / (d1 - d3);
  take((area_a <= zero) & (e43 >= zero) & (e56 >= zero), zero, one - along_bc, along_bc);
  take((area_b <= zero) & (d2 >= zero) & (d6 <= zero), one - along_ac, zero, along_ac);
  take((d6 >= zero) & (d5 <= d6), zero, zero, one);
  take((area_c <= zero) & (d1 >= zero) & (d3 <= zero), one - along_ab, along_ab, zero);
  take((d3 >= zero) & (d4 <= d3), zero, one, zero);
  take((d1 <= zero) & (d2 <= zero), one, zero, zero);
  constexpr double kSliver = 1e-6;  // as in closest_point_on_triangle()
  doubtful = select(ab_ab * ac_ac - ab_ac * ab_ac <= Real(kSliver) * longest2 * longest2, one, doubtful);

  Foot<Real> out{ap - ab * v - ac * w, {u, v, w}, zero, doubtful};
  out.distance2 = norm2(out.away);
  return out;
}

/// The same for one point, right for slivers too.
inline Foot<double> closest_foot_of(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  Foot<double> foot = closest_foot<double>(p, a, b, c);
  if (foot.doubtful == 0.0) return foot;
  const ClosestPoint closest = closest_point_on_triangle(p, a, b, c);
  foot.away = p - closest.point;
  for (int k = 0; k < 3; ++k) foot.mu[k] = closest.barycentric[k];
  foot.distance2 = closest.distance2;
  return foot;
}

}  // namespace morula
