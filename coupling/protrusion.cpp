#include "coupling/protrusion.h"

#include <algorithm>
#include <cmath>

namespace morula {
namespace {

/// Weights of the nodes about an axis of length 1, of sum 1; all zero where there are none.
std::vector<double> front(const Protrusion& law, std::span<const Vec3d> x, std::span<const double> area, const Vec3d& centroid,
                          const Vec3d& axis, const Footing& footing) {
  std::vector<double> weight(x.size(), 0.0);
  const double edge = std::cos(law.angle);
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    Vec3d from = x[i] - centroid;
    if (!footing.touches.empty()) {
      if (!footing.touches[i]) continue;
      from -= footing.normal * dot(from, footing.normal);
    }
    if (norm2(from) > 0.0) weight[i] = area[i] * std::max(0.0, dot(from, axis) / norm(from) - edge);
    sum += weight[i];
  }
  if (sum > 0.0)
    for (double& w : weight) w /= sum;
  return weight;
}

}  // namespace

bool add_protrusion(const Protrusion& law, const Topology& topology, std::span<const Vec3d> x, const Vec3d& polarity,
                    const Footing& footing, const Vec3d& direction, double size, std::span<Vec3d> force) {
  if (norm2(polarity) == 0.0 || norm2(direction) == 0.0 || size == 0.0) return false;
  std::vector<double> area(x.size(), 0.0);
  for (const Triangle& t : topology.faces()) {
    const double third = norm(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])) / 6.0;
    for (const std::uint32_t node : t) area[node] += third;
  }
  const Vec3d centroid = volume_centroid(topology.faces(), x), axis = normalized(polarity), along = normalized(direction),
              push = along * size;
  const std::vector<double> head = front(law, x, area, centroid, footing.touches.empty() ? axis : along, footing);
  if (std::all_of(head.begin(), head.end(), [](double w) { return w == 0.0; })) return false;
  for (std::size_t i = 0; i < x.size(); ++i) force[i] += push * head[i];
  if (!law.internal) return true;
  const std::vector<double> tail = front(law, x, area, centroid, -axis, {});
  for (std::size_t i = 0; i < x.size(); ++i) force[i] -= push * tail[i];
  return true;
}

}  // namespace morula
