#include "core/mesh/renewal/area_return.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/renewal/surface_fit.h"

namespace morula {
namespace {

constexpr int kSteps = 6;
constexpr double kVolumeMet = 2e-15;  // relative
constexpr double kAreaMet = 1e-10;    // relative

double area_of(std::span<const Triangle> faces, std::span<const Vec3d> x) {
  double sum = 0.0;
  for (const auto& [a, b, c] : faces) sum += 0.5 * norm(cross(x[b] - x[a], x[c] - x[a]));
  return sum;
}

/// ∂A/∂x by node [µm].
std::vector<Vec3d> area_gradient(std::span<const Triangle> faces, std::span<const Vec3d> x) {
  std::vector<Vec3d> out(x.size());
  for (const Triangle& face : faces) {
    const Vec3d twice = cross(x[face[1]] - x[face[0]], x[face[2]] - x[face[0]]);
    const double length = norm(twice);
    if (!(length > 0.0)) continue;
    for (std::size_t c = 0; c < 3; ++c) out[face[c]] += cross(twice / length, x[face[(c + 2) % 3]] - x[face[(c + 1) % 3]]) * 0.5;
  }
  return out;
}

}  // namespace

double give_area_back(std::span<const Triangle> faces, double area, double volume, double most, std::vector<Vec3d>& x) {
  const Vec3d origin = volume_centroid(faces, x);
  const std::vector<Vec3d> of_area = area_gradient(faces, x), of_volume = volume_gradient(faces, x);
  // |∂V/∂x| is the area for which a node stands; along its normal both gradients are numbers, over that area a curvature and one.
  std::vector<Vec3d> normal(x.size());
  std::vector<double> weight(x.size()), bent(x.size(), 0.0);
  double w = 0.0, wb = 0.0, wbb = 0.0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    weight[n] = norm(of_volume[n]);
    if (!(weight[n] > 0.0)) continue;
    normal[n] = of_volume[n] / weight[n];
    bent[n] = dot(of_area[n], normal[n]) / weight[n];
    w += weight[n], wb += weight[n] * bent[n], wbb += weight[n] * bent[n] * bent[n];
  }
  const double det = w * wbb - wb * wb;
  if (!(det > 0.0)) return -1.0;
  std::vector<Vec3d> moved = x;
  double even = 0.0, curved = 0.0;  // the way of a node is even + curved · bent
  for (int step = 0; step < kSteps; ++step) {
    const double more_area = area - area_of(faces, moved), more_volume = volume - enclosed_volume(faces, moved, origin);
    const bool area_met = std::abs(more_area) <= kAreaMet * area;
    if (area_met && std::abs(more_volume) <= kVolumeMet * volume) break;
    const double d_curved = area_met ? 0.0 : (w * more_area - wb * more_volume) / det;
    curved += d_curved;
    even += (more_volume - wb * d_curved) / w;
    for (std::size_t n = 0; n < x.size(); ++n) {
      const double way = even + curved * bent[n];
      if (!(std::abs(way) <= most)) return -1.0;
      moved[n] = x[n] + normal[n] * way;
    }
  }
  double longest = 0.0;
  for (std::size_t n = 0; n < x.size(); ++n) longest = std::max(longest, norm(moved[n] - x[n]));
  x = std::move(moved);
  return longest;
}

}  // namespace morula
