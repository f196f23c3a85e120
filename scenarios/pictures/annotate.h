#pragma once
#include <span>
#include <string_view>

#include "scenarios/pictures/coloring.h"
#include "scenarios/pictures/image.h"

namespace morula::scenarios {

/// A bar of round length.
struct ScaleBar {
  double length = 0.0;  ///< [µm]
  double pixels = 0.0;  ///< length × pixels per µm
  std::string label;    ///< "50 µm"; nm and mm where these read better
};

/// The longest bar of 1, 2, 5 × 10^k µm that is at most `widest` pixels.
ScaleBar make_scale_bar(double pixels_per_um, double widest);

/// The bar with its left end at (x, y), y its lower edge; the text above its middle [px].
void draw_scale_bar(Image& image, double x, double y, const ScaleBar& bar, double cap_height);

/// Horizontal colour bar with ticks; (right, y) is the lower right corner of the coloured strip, quantity and unit above it.
void draw_color_bar(Image& image, double right, double y, double width, const ColorScale& scale, double cap_height);

/// Squares with text, right-aligned at `right`, lines downwards from y.
void draw_legend(Image& image, double right, double y, std::span<const LegendEntry> entries, double cap_height);

/// A number as people write it: no needless digits, at most `digits` significant ones.
std::string short_number(double value, int digits = 4);

/// Units of a text as people write them: µm, µm², µm³ for um, um^2, um^3.
std::string display_text(std::string_view text);

/// A time with the unit that suits it: "40 s", "12 min", "36 h".
std::string short_time(double seconds);

}  // namespace morula::scenarios
