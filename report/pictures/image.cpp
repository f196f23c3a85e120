#include "report/pictures/image.h"

#include <algorithm>
#include <cmath>

namespace morula::scenarios {
namespace {

std::uint8_t to_byte(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

}  // namespace

Image::Image(int width_, int height_, const Rgb& background)
    : width(width_), height(height_), rgb(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 3) {
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    rgb[i] = to_byte(background.r);
    rgb[i + 1] = to_byte(background.g);
    rgb[i + 2] = to_byte(background.b);
  }
}

Rgb Image::at(int x, int y) const {
  const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  return {static_cast<float>(rgb[i]) / 255.0f, static_cast<float>(rgb[i + 1]) / 255.0f, static_cast<float>(rgb[i + 2]) / 255.0f};
}

void Image::set(int x, int y, const Rgb& color) {
  const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  rgb[i] = to_byte(color.r);
  rgb[i + 1] = to_byte(color.g);
  rgb[i + 2] = to_byte(color.b);
}

void Image::blend(int x, int y, const Rgb& color, float opacity) {
  if (x < 0 || y < 0 || x >= width || y >= height || opacity <= 0.0f) return;
  set(x, y, mix(at(x, y), color, std::min(opacity, 1.0f)));
}

void Image::fill_rectangle(double x0, double y0, double x1, double y1, const Rgb& color, float opacity) {
  for (int y = static_cast<int>(std::floor(y0)); y < static_cast<int>(std::ceil(y1)); ++y) {
    const double cover_y = std::min(y1, y + 1.0) - std::max(y0, static_cast<double>(y));
    for (int x = static_cast<int>(std::floor(x0)); x < static_cast<int>(std::ceil(x1)); ++x) {
      const double cover_x = std::min(x1, x + 1.0) - std::max(x0, static_cast<double>(x));
      blend(x, y, color, static_cast<float>(cover_x * cover_y) * opacity);
    }
  }
}

void Image::stroke(double x0, double y0, double x1, double y1, double width_px, const Rgb& color) {
  const double reach = 0.5 * width_px + 1.0;
  const double dx = x1 - x0, dy = y1 - y0, length2 = dx * dx + dy * dy;
  for (int y = static_cast<int>(std::floor(std::min(y0, y1) - reach)); y <= static_cast<int>(std::ceil(std::max(y0, y1) + reach)); ++y) {
    for (int x = static_cast<int>(std::floor(std::min(x0, x1) - reach)); x <= static_cast<int>(std::ceil(std::max(x0, x1) + reach)); ++x) {
      const double px = x + 0.5 - x0, py = y + 0.5 - y0;
      const double t = length2 > 0.0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0.0;
      const double distance = std::sqrt((px - t * dx) * (px - t * dx) + (py - t * dy) * (py - t * dy));
      blend(x, y, color, static_cast<float>(std::clamp(0.5 * width_px + 0.5 - distance, 0.0, 1.0)));
    }
  }
}

void Image::fill_disc(double x, double y, double radius, const Rgb& color) { stroke(x, y, x, y, 2.0 * radius, color); }

}  // namespace morula::scenarios
