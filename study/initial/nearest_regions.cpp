#include "study/initial/nearest_regions.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/ball.h"
#include "core/mesh/triangle_tree.h"
#include "core/spiral.h"

namespace morula::scenarios {
namespace {

constexpr int kDirections = 2000;
constexpr double kPrecision = 1e-4;  // of the way to the inflated hull [µm]

/// How deep a point lies below the hull inflated by the margin, at least; negative outside, where it is the distance.
class InflatedHull {
 public:
  InflatedHull(const ConvexHull& hull, double margin) : hull_(hull), margin_(margin), tree_(hull.points, hull.faces) {}

  [[nodiscard]] double depth(const Vec3d& p) const {
    const double below = hull_.depth(p);
    if (below >= 0.0) return margin_ + below;
    const auto nearest = tree_.nearest(p);
    return margin_ - (nearest ? norm(p - nearest->closest.point) : 0.0);
  }
  /// Way from a point inside to the border, no further than `most`.
  [[nodiscard]] double way_out(const Vec3d& from, const Vec3d& direction, double most) const {
    if (depth(from + direction * most) >= 0.0) return most;  // it is convex
    double way = 0.0;
    for (double left = depth(from); left > kPrecision && way < most; left = depth(from + direction * way)) way += left;
    return std::min(way, most);
  }

 private:
  const ConvexHull& hull_;
  double margin_;
  TriangleTree tree_;
};

/// Way to a ball from outside; without an end where it is not met.
double way_to(const Hollow& ball, const Vec3d& from, const Vec3d& direction) {
  const Vec3d to = ball.center - from;
  const double along = dot(to, direction), miss2 = norm2(to) - along * along, half2 = ball.radius * ball.radius - miss2;
  return along > 0.0 && half2 > 0.0 ? along - std::sqrt(half2) : 1e300;
}

}  // namespace

std::vector<double> nearest_regions(const ConvexHull& hull, std::span<const Vec3d> places, std::span<const std::vector<std::size_t>> groups,
                                    double margin, const std::optional<Hollow>& hollow) {
  const InflatedHull border(hull, margin);
  std::vector<std::size_t> same(places.size());  // the first of those at one place
  std::iota(same.begin(), same.end(), std::size_t{0});
  std::vector<double> of_place(places.size(), 1.0);
  for (const auto& group : groups)
    for (const std::size_t i : group) same[i] = group.front(), of_place[i] = static_cast<double>(group.size());
  Box box;
  for (const Vec3d& p : places) box.include(p);
  const double across = norm(box.high - box.low) + 2.0 * margin;
  std::vector<double> volume(places.size(), 0.0);
  std::vector<std::pair<double, std::size_t>> others;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (same[i] != i) continue;
    const bool outside = hollow && norm(places[i] - hollow->center) >= hollow->radius;
    others.clear();
    for (std::size_t j = 0; j < places.size(); ++j)
      if (same[j] == j && j != i) others.emplace_back(norm(places[j] - places[i]), j);
    std::sort(others.begin(), others.end());
    double sum = 0.0;
    for (int k = 0; k < kDirections; ++k) {
      const Vec3d direction = spiral_direction(k, kDirections);
      double way = outside ? std::min(across, way_to(*hollow, places[i], direction)) : across;
      for (const auto& [distance, j] : others) {
        if (0.5 * distance >= way) break;
        const double along = dot(places[j] - places[i], direction);
        if (along > 0.0) way = std::min(way, 0.5 * distance * distance / along);
      }
      sum += std::pow(border.way_out(places[i], direction, way), 3);
    }
    volume[i] = sum / kDirections * ball_volume(1.0);
  }
  for (std::size_t i = 0; i < places.size(); ++i)
    if (same[i] != i) volume[i] = volume[same[i]];
  for (std::size_t i = 0; i < places.size(); ++i) volume[i] /= of_place[i];
  const double sum = std::accumulate(volume.begin(), volume.end(), 0.0),
               whole = hull.inflated_volume(margin) - (hollow ? ball_volume(hollow->radius) : 0.0);
  for (double& v : volume) v *= whole / sum;
  return volume;
}

}  // namespace morula::scenarios
