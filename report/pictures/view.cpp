#include "report/pictures/view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace morula::scenarios {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A camera that looks along an axis (0, 1, 2), with `up_axis` to the top of the picture.
Camera along_axis(std::size_t axis, std::size_t up_axis, double sign) {
  Camera camera;
  camera.toward = camera.up = {};
  camera.toward[axis] = sign;
  camera.up[up_axis] = 1.0;
  camera.right = cross(camera.up, camera.toward);
  return camera;
}

/// Obstacles are mostly plates and tubes along the axes: from above, one of them would lie before the cells.
View ball_view(bool obstacles) {
  View view;
  view.whole = obstacles ? make_camera(0.0, 0.0) : make_camera(30.0 * kDegree, 22.0 * kDegree);
  view.cut = make_camera(0.0, 0.0);
  view.cut_normal = view.cut.toward;
  return view;
}

/// Along the thin direction: from above, or for an upright layer from its front.
View layer_view(std::size_t thin) {
  View view;
  view.layout = Layout::kLayer;
  view.whole = view.cut = thin == 2 ? along_axis(2, 1, 1.0) : along_axis(thin, 2, thin == 1 ? -1.0 : 1.0);
  view.cut_normal = view.cut.toward;
  return view;
}

/// The row goes across the picture and is cut along itself. An upright row is seen from the front.
View row_view(std::size_t along, bool obstacles) {
  View view;
  view.layout = Layout::kRow;
  const double azimuth = along == 1 ? 90.0 * kDegree : 0.0;
  view.whole = make_camera(azimuth, (obstacles ? 5.0 : 12.0) * kDegree);
  view.cut = make_camera(azimuth, 0.0);
  view.cut_normal = view.cut.toward;
  return view;
}

/// Area of all cells in planes across `normal` at these heights, cells taken as balls.
double cut_area(const Snapshot& snapshot, const Vec3d& normal, double height) {
  double area = 0.0;
  for (const Snapshot::Cell& cell : snapshot.cells) {
    const double d = dot(cell.centroid, normal) - height;
    area += std::numbers::pi * std::max(0.0, cell.radius * cell.radius - d * d);
  }
  return area;
}

}  // namespace

View choose_view(std::span<const Snapshot> snapshots) {
  Vec3d low{1e300, 1e300, 1e300}, high = -low;
  for (const Snapshot& snapshot : snapshots)
    for (const Snapshot::Cell& cell : snapshot.cells)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(cell.centroid[axis]) || !(cell.radius >= 0.0)) continue;
        low[axis] = std::min(low[axis], cell.centroid[axis] - cell.radius);
        high[axis] = std::max(high[axis], cell.centroid[axis] + cell.radius);
      }
  const bool obstacles = std::any_of(snapshots.begin(), snapshots.end(), [](const Snapshot& s) { return !s.obstacles.empty(); });
  if (!(low.x <= high.x)) return ball_view(obstacles);
  const Vec3d size = high - low;
  std::array<std::size_t, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return size[a] < size[b]; });
  constexpr double kLong = 1.6, kThin = 0.4;
  if (size[order[2]] > kLong * size[order[1]]) return row_view(order[2], obstacles);
  if (size[order[0]] < kThin * size[order[1]]) return layer_view(order[0]);
  return ball_view(obstacles);
}

std::optional<CutPlane> place_cut(const Snapshot& snapshot, const Vec3d& normal) {
  double low = 1e300, high = -1e300;
  for (const Snapshot::Cell& cell : snapshot.cells) {
    const double height = dot(cell.centroid, normal);
    if (!std::isfinite(height) || !(cell.radius > 0.0)) continue;
    low = std::min(low, height - cell.radius);
    high = std::max(high, height + cell.radius);
  }
  if (!(low < high)) return std::nullopt;
  constexpr int kTried = 48;
  constexpr double kEnough = 0.6;
  const double middle = dot(middle_of(snapshot), normal);
  double best = middle, best_area = 0.0;
  for (int i = 1; i < kTried; ++i) {
    const double height = low + (high - low) * i / kTried, area = cut_area(snapshot, normal, height);
    if (area > best_area) best = height, best_area = area;
  }
  const double at_middle = cut_area(snapshot, normal, middle);
  if (!(std::max(at_middle, best_area) > 0.0)) return std::nullopt;
  return CutPlane{normal * (at_middle >= kEnough * best_area ? middle : best), normal};
}

double aspect_of(const Camera& camera, std::span<const Snapshot> snapshots) {
  Camera fitted = camera;
  fit_camera(fitted, snapshots, 1.0, 1e9);
  const double across = 1.0 / fitted.pixels_per_um;
  fit_camera(fitted, snapshots, 1e9, 1.0);
  return std::clamp(1.0 / fitted.pixels_per_um / across, 0.25, 1.0);
}

}  // namespace morula::scenarios
