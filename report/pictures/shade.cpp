#include "report/pictures/shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace morula::scenarios {
namespace {

constexpr Rgb kBackground{1.0f, 1.0f, 1.0f};
constexpr Rgb kOutline{0.10f, 0.11f, 0.15f};
constexpr int kOcclusionSamples = 8;
constexpr std::size_t kTurns = 16;  // of the samples

struct Offset {
  float x, y;
};

// Spiral of points in the unit disc, evenly spread (Vogel 1979).
std::array<Offset, kOcclusionSamples> spiral() {
  std::array<Offset, kOcclusionSamples> out{};
  for (int k = 0; k < kOcclusionSamples; ++k) {
    const double r = std::sqrt((k + 0.5) / kOcclusionSamples), angle = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
    out[static_cast<std::size_t>(k)] = {static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle))};
  }
  return out;
}

// Interleaved gradient noise in 0..1 (Jimenez 2014, "Next generation post processing", SIGGRAPH course): even over each 3×3 block.
float noise(int x, int y) {
  const float f = 0.06711056f * static_cast<float>(x) + 0.00583715f * static_cast<float>(y);
  const float g = 52.9829189f * (f - std::floor(f));
  return g - std::floor(g);
}

class Shader {
 public:
  Shader(const PixelBuffer& pixels, std::span<const Rgb> colors, std::span<const std::optional<Rgb>> face_colors,
         const DrawnSurroundings& around, const ShadeOptions& options)
      : pixels_(pixels),
        colors_(colors),
        face_colors_(face_colors),
        around_(around),
        options_(options),
        is_smooth_(face_colors.empty() && around.fluid.empty() && !around.obstacles && options.samples % 2 == 1),
        spiral_(spiral()) {
    reach_px_ = static_cast<float>(std::clamp(1.3 * options.cell_radius * options.pixels_per_um, 2.0, 150.0));
    const double cell_px = 2.0 * options.cell_radius * options.pixels_per_um / options.samples;
    line_opacity_ = static_cast<float>(std::clamp((cell_px - 3.0) / 18.0, 0.12, 0.88));
    line_reach_ = std::max(1, (2 * options.samples + 1) / 3);
    for (const float depth : pixels.depth) {
      if (!std::isfinite(depth)) continue;
      nearest_ = std::max(nearest_, depth);
      farthest_ = std::min(farthest_, depth);
    }
    for (std::size_t i = 0; i < kTurns; ++i) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kTurns;
      turn_[i] = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
    }
    find_whole_pixels();
    find_openness();
  }

  /// Mean of the sub-pixels of a pixel. Where the pixel shows one surface, its sub-pixels are all as open as the mean of the pixels around that show
  /// it, too; and no line is looked for where all pixels around do.
  [[nodiscard]] Rgb pixel(int column, int row) const {
    const int n = options_.samples, x = column * n, y = row * n;
    const std::int32_t whole = whole_[index_of_pixel(column, row)];
    const bool inner = is_inner(column, row);
    if (whole == PixelBuffer::kNothing && inner && around_.fluid.empty() && !around_.obstacles) return kBackground;
    std::optional<float> open;
    if (has_openness(whole)) open = mean_openness(column, row);
    const bool lines = options_.outlines && !inner;
    if (inner && is_smooth_) return sub_pixel(x + n / 2, y + n / 2, open, lines);  // its light is that of its middle
    Rgb sum;
    for (int sy = 0; sy < n; ++sy)
      for (int sx = 0; sx < n; ++sx) sum = sum + sub_pixel(x + sx, y + sy, open, lines);
    return sum * (1.0f / static_cast<float>(n * n));
  }

 private:
  static constexpr std::int32_t kMixed = -2;  ///< the sub-pixels of a pixel show more than one surface

  [[nodiscard]] std::size_t index_of_pixel(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(pixels_.width / options_.samples) + static_cast<std::size_t>(column);
  }
  /// The surface that all sub-pixels of each pixel show.
  void find_whole_pixels() {
    const int n = options_.samples, rows = pixels_.height / n, columns = pixels_.width / n;
    whole_.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const std::int32_t first = pixels_.surface[pixels_.index(column * n, row * n)];
        bool same = true;
        for (int sy = 0; sy < n; ++sy)
          for (int sx = 0; sx < n; ++sx) same = same && pixels_.surface[pixels_.index(column * n + sx, row * n + sy)] == first;
        whole_[index_of_pixel(column, row)] = same ? first : kMixed;
      }
  }
  static bool has_openness(std::int32_t whole) { return whole >= 0 && whole % 2 == 0; }
  /// How open the place in the middle of each pixel is that shows one surface.
  void find_openness() {
    const int n = options_.samples, rows = pixels_.height / n, columns = pixels_.width / n;
    open_.resize(whole_.size());
#pragma omp parallel for schedule(dynamic, 16)
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const std::size_t i = index_of_pixel(column, row);
        if (has_openness(whole_[i])) open_[i] = openness(column * n + n / 2, row * n + n / 2, noise(column, row));
      }
  }
  [[nodiscard]] float mean_openness(int column, int row) const {
    const std::int32_t whole = whole_[index_of_pixel(column, row)];
    float sum = 0.0f;
    int count = 0;
    for_pixels_around(column, row, [&](std::size_t i) {
      if (whole_[i] == whole) sum += open_[i], ++count;
    });
    return sum / static_cast<float>(count);
  }
  /// function(number) for the pixel and those around it.
  template <class F>
  void for_pixels_around(int column, int row, F&& function) const {
    const int columns = pixels_.width / options_.samples, rows = pixels_.height / options_.samples;
    for (int y = std::max(0, row - 1); y <= std::min(rows - 1, row + 1); ++y)
      for (int x = std::max(0, column - 1); x <= std::min(columns - 1, column + 1); ++x) function(index_of_pixel(x, y));
  }
  /// The pixel and all around it show the same surface: the reach of lines is less than a pixel.
  [[nodiscard]] bool is_inner(int column, int row) const {
    const std::int32_t whole = whole_[index_of_pixel(column, row)];
    if (whole == kMixed) return false;
    bool same = true;
    for_pixels_around(column, row, [&](std::size_t i) { same = same && whole_[i] == whole; });
    return same;
  }

  /// `open`: of the pixel, where it is known; `lines`: some may be near.
  [[nodiscard]] Rgb sub_pixel(int x, int y, std::optional<float> open, bool lines) const {
    const std::size_t i = pixels_.index(x, y);
    const auto surface = pixels_.surface[i];
    Rgb color = surface == PixelBuffer::kNothing ? kBackground : lit(x, y, i, surface, open);
    if (!around_.fluid.empty() && around_.fluid[i] != 0) color = mix(color, kFluidColor, surface == PixelBuffer::kNothing ? 1.0f : 0.7f);
    if (lines && on_border(pixels_, x, y, surface)) color = mix(color, kOutline, line_opacity_);
    return around_.obstacles ? with_obstacle(x, y, i, color) : color;
  }

  [[nodiscard]] Rgb with_obstacle(int x, int y, std::size_t i, const Rgb& color) const {
    const PixelBuffer& obstacles = *around_.obstacles;
    const auto obstacle = obstacles.surface[i], cell = pixels_.surface[i];
    const bool hidden = cell != PixelBuffer::kNothing && (obstacle == PixelBuffer::kNothing || obstacles.depth[i] <= pixels_.depth[i]);
    if (hidden) return color;
    Rgb seen = color;
    if (obstacle != PixelBuffer::kNothing) {
      const bool is_cut = obstacle % 2 == 1;
      const bool hollow = around_.hollow[static_cast<std::size_t>(obstacle / 2)];
      const float nz = normal_at(obstacles, i).z;
      const Rgb lit = is_cut ? kObstacleColor * 0.85f : mix({1.0f, 1.0f, 1.0f}, kObstacleColor, 0.75f - 0.4f * nz);
      const float opacity = is_cut ? (hollow ? 0.0f : 1.0f) : cell == PixelBuffer::kNothing ? 0.9f : 0.25f;
      seen = mix(seen, lit, opacity);
    }
    return on_border(obstacles, x, y, obstacle) ? mix(seen, kOutline, 0.4f) : seen;
  }

  struct Normal {
    float x, y, z;
  };
  static Normal normal_at(const PixelBuffer& pixels, std::size_t i) {
    const float x = static_cast<float>(pixels.normal_x[i]) / 32767.0f, y = static_cast<float>(pixels.normal_y[i]) / 32767.0f;
    return {x, y, std::sqrt(std::max(0.0f, 1.0f - x * x - y * y))};
  }

  [[nodiscard]] Rgb lit(int x, int y, std::size_t i, std::int32_t surface, std::optional<float> open_of_pixel) const {
    const std::uint32_t face = pixels_.face[i];
    const Rgb base =
        face < face_colors_.size() && face_colors_[face] ? *face_colors_[face] : colors_[static_cast<std::size_t>(surface / 2)];
    if (surface % 2 == 1) return mix(base, {1.0f, 1.0f, 1.0f}, options_.cut_lightening);
    const auto [nx, ny, nz] = normal_at(pixels_, i);
    const float open = open_of_pixel ? *open_of_pixel : openness(x, y, noise(x, y));
    // light from (−0.42, 0.58, 0.70); half Lambert keeps the shadow side readable
    const float wrap = 0.5f + 0.5f * (-0.42f * nx + 0.58f * ny + 0.70f * nz);
    const float brightness = (0.46f + 0.62f * wrap * wrap) * (0.34f + 0.66f * open) * (0.86f + 0.14f * nz);
    const float glance = std::max(0.0f, -0.228f * nx + 0.315f * ny + 0.921f * nz);      // half-way vector of light and eye
    const float shine = glance > 0.7f ? 0.03f * std::pow(glance, 30.0f) * open : 0.0f;  // below: less than 1e-6
    const Rgb shaded = base * brightness + Rgb{shine, shine, shine};
    const float range = nearest_ - farthest_;
    const float fade = range > 0.0f ? 0.16f * (nearest_ - pixels_.depth[i]) / range : 0.0f;
    return mix(shaded, kBackground, fade);
  }

  // 1 where nothing stands around the point, 0 in a deep furrow. The samples are turned by this part of a whole turn.
  [[nodiscard]] float openness(int x, int y, float part_of_turn) const {
    const std::size_t i = pixels_.index(x, y);
    const auto [nx, ny, nz] = normal_at(pixels_, i);
    const float um_per_px = 1.0f / static_cast<float>(options_.pixels_per_um);
    const float reach = reach_px_ * um_per_px, depth = pixels_.depth[i];
    const Offset turn = turn_[static_cast<std::size_t>(part_of_turn * kTurns) % kTurns];
    float hidden = 0.0f;
    for (const Offset& s : spiral_) {
      const int dx = static_cast<int>(std::lrint((s.x * turn.x - s.y * turn.y) * reach_px_));
      const int dy = static_cast<int>(std::lrint((s.x * turn.y + s.y * turn.x) * reach_px_));
      const int sx = x + dx, sy = y + dy;
      if (sx < 0 || sy < 0 || sx >= pixels_.width || sy >= pixels_.height) continue;
      const float other = pixels_.depth[pixels_.index(sx, sy)];
      if (!(other > -1e30f)) continue;
      const float vx = static_cast<float>(dx) * um_per_px, vy = -static_cast<float>(dy) * um_per_px, vz = other - depth;
      const float rise = vx * nx + vy * ny + vz * nz - 0.02f * reach;
      if (rise > 0.0f) hidden += rise * reach / (vx * vx + vy * vy + vz * vz + 0.01f * reach * reach);
    }
    return std::max(0.0f, 1.0f - 0.95f * hidden / kOcclusionSamples);
  }

  [[nodiscard]] bool on_border(const PixelBuffer& pixels, int x, int y, std::int32_t surface) const {
    const int r = line_reach_, d = std::max(1, (r * 7 + 5) / 10);  // straight and diagonal reach
    const std::array<std::pair<int, int>, 8> around = {{{r, 0}, {-r, 0}, {0, r}, {0, -r}, {d, d}, {-d, d}, {d, -d}, {-d, -d}}};
    for (const auto& [dx, dy] : around) {
      const int sx = std::clamp(x + dx, 0, pixels.width - 1), sy = std::clamp(y + dy, 0, pixels.height - 1);
      if (pixels.surface[pixels.index(sx, sy)] != surface) return true;
    }
    return false;
  }

  const PixelBuffer& pixels_;
  std::span<const Rgb> colors_;
  std::span<const std::optional<Rgb>> face_colors_;
  const DrawnSurroundings& around_;
  ShadeOptions options_;
  bool is_smooth_;  ///< light and colour change slowly over each surface
  std::array<Offset, kOcclusionSamples> spiral_;
  std::array<Offset, kTurns> turn_{};
  std::vector<std::int32_t> whole_;  ///< by pixel: the surface that all of its sub-pixels show, or kMixed
  std::vector<float> open_;          ///< by pixel: find_openness()
  float reach_px_, line_opacity_, nearest_ = -1e30f, farthest_ = 1e30f;
  int line_reach_;
};

}  // namespace

void shade(const PixelBuffer& pixels, std::span<const Rgb> colors, std::span<const std::optional<Rgb>> face_colors,
           const DrawnSurroundings& around, const ShadeOptions& options, Image& image, int left, int top) {
  const Shader shader(pixels, colors, face_colors, around, options);
  const int rows = pixels.height / options.samples, columns = pixels.width / options.samples;
#pragma omp parallel for schedule(dynamic, 16)
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) image.set(left + column, top + row, shader.pixel(column, row));
}

}  // namespace morula::scenarios
