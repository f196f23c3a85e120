#pragma once
#include <cstdint>

#include "core/vec3.h"

namespace morula {

/// Part of a triangle on which a nearest point lies. kEdge0 is the edge opposite to corner 0, as in Topology::face_edges().
enum class TriangleFeature : std::uint8_t { kFace, kEdge0, kEdge1, kEdge2, kVertex0, kVertex1, kVertex2 };

/// The point of a triangle that is nearest to some point.
struct ClosestPoint {
  Vec3d point;
  /// Weights of the corners, >= 0, sum 1. On an edge exactly one weight is zero, at a vertex two are: zeros and `feature` always agree.
  double barycentric[3] = {1.0, 0.0, 0.0};
  double distance2 = 0.0;  ///< |p − point|² [µm²]
  TriangleFeature feature = TriangleFeature::kVertex0;
};

namespace closest_point_detail {

inline ClosestPoint at_vertex(const Vec3d& p, const Vec3d& corner, int number) {
  ClosestPoint out;
  out.point = corner;
  out.barycentric[0] = 0.0;
  out.barycentric[number] = 1.0;
  out.distance2 = norm2(p - corner);
  out.feature = static_cast<TriangleFeature>(static_cast<int>(TriangleFeature::kVertex0) + number);
  return out;
}

/// At a + t (b − a), where a and b are the corners `na` and `nb`; outside 0 < t < 1 (and for t = NaN) one of the corners.
inline ClosestPoint on_edge(const Vec3d& p, const Vec3d& a, const Vec3d& b, int na, int nb, double t) {
  if (!(t > 0.0)) return at_vertex(p, a, na);
  if (!(t < 1.0)) return at_vertex(p, b, nb);
  ClosestPoint out;
  // From the nearer end, so that the result does not depend on the direction of the edge more than rounding asks for.
  out.point = t < 0.5 ? a + (b - a) * t : b + (a - b) * (1.0 - t);
  out.barycentric[0] = 0.0;
  out.barycentric[na] = 1.0 - t;
  out.barycentric[nb] = t;
  out.distance2 = norm2(p - out.point);
  out.feature = static_cast<TriangleFeature>(static_cast<int>(TriangleFeature::kEdge0) + 3 - na - nb);
  return out;
}

inline ClosestPoint on_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b, int na, int nb) {
  const Vec3d ab = b - a;
  const double length2 = norm2(ab);
  return on_edge(p, a, b, na, nb, length2 > 0.0 ? dot(p - a, ab) / length2 : 0.0);
}

inline ClosestPoint on_face(const Vec3d& p, const Vec3d& a, const Vec3d& ab, const Vec3d& ac, double u, double v, double w) {
  ClosestPoint out;
  out.point = a + ab * v + ac * w;
  out.barycentric[0] = u;
  out.barycentric[1] = v;
  out.barycentric[2] = w;
  out.distance2 = norm2(p - out.point);
  out.feature = TriangleFeature::kFace;
  return out;
}

/// The nearest of the three edges, and of the face when the foot of the perpendicular is surely inside. Slower than the region test, but
/// right for slivers and needles too: whatever rounding does to the signs, the result is a point of the triangle, and no edge is nearer.
inline ClosestPoint by_comparison(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  ClosestPoint best = on_segment(p, a, b, 0, 1);
  const ClosestPoint bc = on_segment(p, b, c, 1, 2), ca = on_segment(p, c, a, 2, 0);
  if (bc.distance2 < best.distance2) best = bc;
  if (ca.distance2 < best.distance2) best = ca;
  const Vec3d normal = cross(b - a, c - a);
  const double area2 = norm2(normal);
  if (!(area2 > 0.0)) return best;
  // Over a sliver the weights lose digits; solving again for what is left of the offset brings them back.
  double v = 0.0, w = 0.0;
  for (int pass = 0; pass < 3; ++pass) {
    const Vec3d left = p - (a + (b - a) * v + (c - a) * w);
    v += dot(cross(left, c - a), normal) / area2;
    w += dot(cross(b - a, left), normal) / area2;
  }
  const double u = 1.0 - v - w;
  if (!(u > 0.0 && v > 0.0 && w > 0.0)) return best;
  const ClosestPoint face = on_face(p, a, b - a, c - a, u, v, w);
  return face.distance2 < best.distance2 ? face : best;
}

}  // namespace closest_point_detail

/// The point of triangle (a, b, c) nearest to p, by the signs that tell which Voronoi region of the triangle p lies in (idea: Ericson 2005,
/// Real-Time Collision Detection, 5.1.5). Triangles without area, down to a single point, are treated as the edges they are.
/// The distance is right to rounding, for slivers (height below 10⁻³ of the longest side) to 10⁻⁸ of the longest side.
/// A function of its arguments alone; finite for finite arguments whose squares do not overflow.
inline ClosestPoint closest_point_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  namespace detail = closest_point_detail;
  const Vec3d ab = b - a, ac = c - a, ap = p - a;
  const double ab_ab = dot(ab, ab), ab_ac = dot(ab, ac), ac_ac = dot(ac, ac);
  // The signs below are trusted when the triangle is no sliver: sin² of the angle at a, and the like at the other corners.
  constexpr double kSliver = 1e-6;
  const double bc_bc = ab_ab - 2.0 * ab_ac + ac_ac;
  const double longest2 = ab_ab > ac_ac ? (ab_ab > bc_bc ? ab_ab : bc_bc) : (ac_ac > bc_bc ? ac_ac : bc_bc);
  if (!(ab_ab * ac_ac - ab_ac * ab_ac > kSliver * longest2 * longest2)) return detail::by_comparison(p, a, b, c);

  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return detail::at_vertex(p, a, 0);
  const Vec3d bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return detail::at_vertex(p, b, 1);
  const double area_c = d1 * d4 - d3 * d2;
  if (area_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return detail::on_edge(p, a, b, 0, 1, d1 / (d1 - d3));
  const Vec3d cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return detail::at_vertex(p, c, 2);
  const double area_b = d5 * d2 - d1 * d6;
  if (area_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return detail::on_edge(p, a, c, 0, 2, d2 / (d2 - d6));
  const double area_a = d3 * d6 - d5 * d4;
  if (area_a <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return detail::on_edge(p, b, c, 1, 2, (d4 - d3) / ((d4 - d3) + (d5 - d6)));

  const double scale = 1.0 / (area_a + area_b + area_c);
  const double u = area_a * scale, v = area_b * scale, w = area_c * scale;
  // Rounding may let a point slip past the tests above; inside, all three weights are positive.
  if (!(u > 0.0 && v > 0.0 && w > 0.0)) return detail::by_comparison(p, a, b, c);
  return detail::on_face(p, a, ab, ac, u, v, w);
}

}  // namespace morula
