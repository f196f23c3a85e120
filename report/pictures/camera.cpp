#include "report/pictures/camera.h"

#include <cmath>
#include <limits>

namespace morula::scenarios {
namespace {

struct Extent {
  Vec3d low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec3d high = -low;

  void add(const Vec3d& p, double reach) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!std::isfinite(p[i])) return;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i] - reach);
      high[i] = std::max(high[i], p[i] + reach);
    }
  }
  [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
};

}  // namespace

Camera make_camera(double azimuth, double elevation) {
  Camera camera;
  camera.right = {std::cos(azimuth), std::sin(azimuth), 0.0};
  camera.toward = {std::sin(azimuth) * std::cos(elevation), -std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
  camera.up = cross(camera.toward, camera.right);
  return camera;
}

void fit_camera(Camera& camera, std::span<const Snapshot> snapshots, double width, double height) {
  camera.center = {};
  Extent extent;
  for (const Snapshot& snapshot : snapshots) {
    for (const auto& cell : snapshot.cells)
      if (cell.body == BodyKind::kSphere && cell.radius > 0.0) extent.add(camera.view(cell.centroid), cell.radius);
    for (const Vec3d& node : snapshot.nodes) extent.add(camera.view(node), 0.0);
  }
  if (extent.empty()) extent.add({}, 50.0);
  const Vec3d middle = (extent.low + extent.high) * 0.5, size = extent.high - extent.low;
  camera.center = camera.right * middle.x + camera.up * middle.y + camera.toward * middle.z;
  constexpr double kRim = 0.95;
  camera.pixels_per_um = kRim * std::min(width / std::max(size.x, 1e-6), height / std::max(size.y, 1e-6));
}

Vec3d middle_of(const Snapshot& snapshot) {
  Vec3d sum;
  for (const auto& cell : snapshot.cells) sum += cell.centroid;
  return snapshot.cells.empty() ? sum : sum / static_cast<double>(snapshot.cells.size());
}

double nice_below(double limit) {
  const double decade = std::pow(10.0, std::floor(std::log10(limit)));
  for (const double step : {5.0, 2.0})
    if (step * decade <= limit * (1.0 + 1e-12)) return step * decade;
  return decade;
}

}  // namespace morula::scenarios
