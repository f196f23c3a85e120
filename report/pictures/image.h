#pragma once
#include <cstdint>
#include <vector>

#include "study/color.h"

namespace morula::scenarios {

/// Pixels in rows from the top, 8 bits a channel, R G B.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  Image() = default;
  Image(int width_, int height_, const Rgb& background);

  [[nodiscard]] Rgb at(int x, int y) const;
  void set(int x, int y, const Rgb& color);
  /// Lay `color` over a pixel with this opacity; nothing happens outside of the image.
  void blend(int x, int y, const Rgb& color, float opacity);
  /// Fill the rectangle [x0, x1) × [y0, y1), given in pixels with fractions: border pixels get the covered part.
  void fill_rectangle(double x0, double y0, double x1, double y1, const Rgb& color, float opacity = 1.0f);
  /// Stroke with round ends and this width, from (x0, y0) to (x1, y1) [px].
  void stroke(double x0, double y0, double x1, double y1, double width_px, const Rgb& color);
  /// Disc of this radius [px].
  void fill_disc(double x, double y, double radius, const Rgb& color);
};

}  // namespace morula::scenarios
