#include "report/pictures/field_slice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/pictures/projection.h"

namespace morula::scenarios {
namespace {

constexpr Rgb kPaper{1.0f, 1.0f, 1.0f}, kOutline{0.10f, 0.11f, 0.15f};

/// Number of what the plane goes through; kNothing beside cells.
std::int32_t in_plane(const PixelBuffer& pixels, int x, int y) {
  const std::int32_t surface = pixels.surface[pixels.index(std::clamp(x, 0, pixels.width - 1), std::clamp(y, 0, pixels.height - 1))];
  return surface != PixelBuffer::kNothing && surface % 2 == 1 ? surface : PixelBuffer::kNothing;
}

bool on_outline(const PixelBuffer& cells, int x, int y, int reach) {
  const std::int32_t here = in_plane(cells, x, y);
  return in_plane(cells, x + reach, y) != here || in_plane(cells, x - reach, y) != here || in_plane(cells, x, y + reach) != here ||
         in_plane(cells, x, y - reach) != here;
}

}  // namespace

double concentration_at(const Snapshot::Grid& grid, const Vec3d& point) {
  std::array<std::size_t, 3> low{}, high{};
  Vec3d part;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double place = (point[axis] - grid.low[axis]) / grid.spacing[axis], count = grid.voxels[axis];
    if (!(place >= 0.0 && place <= count)) return std::numeric_limits<double>::quiet_NaN();
    const double from_center = std::clamp(place - 0.5, 0.0, count - 1.0);
    low[axis] = static_cast<std::size_t>(from_center);
    high[axis] = std::min(low[axis] + 1, static_cast<std::size_t>(grid.voxels[axis]) - 1);
    part[axis] = from_center - static_cast<double>(low[axis]);
  }
  double sum = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    std::array<std::size_t, 3> at{};
    double weight = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool up = (corner >> axis & 1u) != 0;
      at[axis] = up ? high[axis] : low[axis];
      weight *= up ? part[axis] : 1.0 - part[axis];
    }
    const auto nx = static_cast<std::size_t>(grid.voxels[0]), ny = static_cast<std::size_t>(grid.voxels[1]);
    sum += weight * grid.concentration[(at[2] * ny + at[1]) * nx + at[0]];
  }
  return sum;
}

void draw_field_slice(const FieldSlice& slice, const PixelBuffer& cells, const DrawnSurroundings& around, Image& image, int top) {
  const Projection projection{slice.camera, 0.5 * cells.width, 0.5 * cells.height};
  const ClipDepth plane(projection, slice.cut);
  const Camera& camera = slice.camera;
  const auto color_at = [&](int x, int y) {
    const double across = (x + 0.5 - projection.middle_x) / camera.pixels_per_um,
                 up = (projection.middle_y - y - 0.5) / camera.pixels_per_um;
    const Vec3d point = camera.center + camera.right * across + camera.up * up + camera.toward * plane.at(x, y);
    const double value = concentration_at(slice.grid, point);
    Rgb color = std::isfinite(value) ? scale_color(slice.scale, value) : kPaper;
    if (around.obstacles && in_plane(*around.obstacles, x, y) != PixelBuffer::kNothing &&
        !around.hollow[static_cast<std::size_t>(in_plane(*around.obstacles, x, y) / 2)])
      color = kObstacleColor;
    if (!on_outline(cells, x, y, std::max(1, slice.samples / 2))) return color;
    const bool dark = 0.2126f * color.r + 0.7152f * color.g + 0.0722f * color.b < 0.5f;
    return mix(color, dark ? kPaper : kOutline, 0.6f);
  };
  const float weight = 1.0f / static_cast<float>(slice.samples * slice.samples);
#pragma omp parallel for schedule(dynamic, 16)
  for (int row = 0; row < cells.height / slice.samples; ++row)
    for (int column = 0; column < cells.width / slice.samples; ++column) {
      Rgb sum;
      for (int sy = 0; sy < slice.samples; ++sy)
        for (int sx = 0; sx < slice.samples; ++sx) sum = sum + color_at(column * slice.samples + sx, row * slice.samples + sy);
      image.set(column, top + row, sum * weight);
    }
}

}  // namespace morula::scenarios
