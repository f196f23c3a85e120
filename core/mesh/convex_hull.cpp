#include "core/mesh/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/mesh/mean_curvature.h"

namespace morula {
namespace {

using Index = std::uint32_t;

/// A face with its plane.
struct Facet {
  Triangle corners;
  Vec3d normal;  ///< unit, outwards
  double offset = 0.0;

  [[nodiscard]] double above(const Vec3d& p) const { return dot(normal, p) - offset; }
};

Facet facet(const std::vector<Vec3d>& points, Index a, Index b, Index c) {
  const Vec3d n = normalized(cross(points[b] - points[a], points[c] - points[a]));
  return {{a, b, c}, n, dot(n, points[a])};
}

template <class Measure>
Index farthest(const std::vector<Vec3d>& points, Measure&& measure) {
  Index best = 0;
  double most = -1.0;
  for (Index i = 0; i < points.size(); ++i)
    if (const double d = measure(points[i]); d > most) most = d, best = i;
  return best;
}

/// Four points that span a volume, as far apart as an easy choice gives; empty when all lie in one plane.
std::vector<Facet> first_tetrahedron(const std::vector<Vec3d>& points, double tolerance) {
  const Vec3d start = points[farthest(points, [&](const Vec3d& p) { return norm(p - points[0]); })];
  const Index a = farthest(points, [&](const Vec3d& p) { return norm(p - start); });
  const Index b = farthest(points, [&](const Vec3d& p) { return norm(p - points[a]); });
  if (norm(points[b] - points[a]) <= tolerance) return {};
  const Vec3d along = normalized(points[b] - points[a]);
  const Index c = farthest(points, [&](const Vec3d& p) { return norm(cross(p - points[a], along)); });
  if (norm(cross(points[c] - points[a], along)) <= tolerance) return {};
  Facet base = facet(points, a, b, c);
  const Index d = farthest(points, [&](const Vec3d& p) { return std::abs(base.above(p)); });
  if (std::abs(base.above(points[d])) <= tolerance) return {};
  if (base.above(points[d]) > 0.0) base = facet(points, a, c, b);
  const auto [p, q, r] = std::tuple{base.corners[0], base.corners[1], base.corners[2]};
  return {base, facet(points, q, p, d), facet(points, r, q, d), facet(points, p, r, d)};
}

void add_point(std::vector<Facet>& facets, const std::vector<Vec3d>& points, Index index, double tolerance) {
  std::map<std::pair<Index, Index>, bool> edges;  // directed edges of the faces that see the point
  std::vector<Facet> kept;
  for (const Facet& f : facets) {
    if (f.above(points[index]) <= tolerance) {
      kept.push_back(f);
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) edges[{f.corners[k], f.corners[(k + 1) % 3]}] = true;
  }
  if (edges.empty()) return;
  for (const auto& [edge, seen] : edges)
    if (!edges.contains({edge.second, edge.first})) kept.push_back(facet(points, edge.first, edge.second, index));
  facets = std::move(kept);
}

void measure(ConvexHull& hull, const std::vector<Facet>& facets) {
  const Vec3d origin = hull.points[facets.front().corners[0]];
  for (const Facet& f : facets) {
    hull.faces.push_back(f.corners);
    const Vec3d a = hull.points[f.corners[0]] - origin, b = hull.points[f.corners[1]] - origin, c = hull.points[f.corners[2]] - origin;
    hull.volume += dot(a, cross(b, c)) / 6.0;
    hull.area += 0.5 * norm(cross(b - a, c - a));
  }
  hull.mean_curvature = mean_curvature(hull.points, hull.faces);
}

}  // namespace

double ConvexHull::inflated_volume(double margin) const { return volume + layer_around(area, mean_curvature, margin); }

double ConvexHull::depth(const Vec3d& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : faces) least = std::min(least, -facet(points, t[0], t[1], t[2]).above(point));
  return least;
}

Result<ConvexHull> convex_hull(std::vector<Vec3d> points) {
  ConvexHull hull;
  hull.points = std::move(points);
  double extent = 0.0;
  for (const Vec3d& p : hull.points) extent = std::max(extent, norm(p - hull.points[0]));
  const double tolerance = 1e-9 * extent;
  std::vector<Facet> facets;
  if (hull.points.size() >= 4) facets = first_tetrahedron(hull.points, tolerance);
  if (facets.empty()) return Error{ErrorKind::kInput, "the points have no convex hull: fewer than four, or all in one plane", {}};
  Vec3d middle{};
  for (const Facet& f : facets)
    for (const Index i : f.corners) middle += hull.points[i] * (1.0 / 12.0);
  std::vector<Index> order(hull.points.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return norm2(hull.points[a] - middle) > norm2(hull.points[b] - middle); });
  for (const Index i : order) add_point(facets, hull.points, i, tolerance);
  measure(hull, facets);
  return hull;
}

}  // namespace morula
