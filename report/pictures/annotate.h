#pragma once
#include <span>
#include <string_view>

#include "report/pictures/camera.h"
#include "report/pictures/coloring.h"
#include "report/pictures/image.h"

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

/// Numbers on a colour bar, both ends among them: a few at round steps where these meet both ends, else the ends and, on a scale that
/// parts at zero, zero [internal units].
std::vector<double> color_bar_numbers(const ColorScale& scale);

/// Horizontal colour bar with ticks; (right, y) is the lower right corner of the coloured strip. Quantity and unit stand above it,
/// numbers and the range of the data below.
void draw_color_bar(Image& image, double right, double y, double width, const ColorScale& scale, double cap_height);

/// Entries of a legend in rows: the number of each row's entries. The first row is `first_width` pixels wide, the others `width`.
std::vector<std::size_t> legend_rows(std::span<const LegendEntry> entries, double first_width, double width, double cap_height);

/// Height of a row of a legend over that of its capitals.
inline constexpr double kLegendLine = 2.1;

/// Dots with text in rows of these numbers of entries, right-aligned at `right`, downwards from y.
void draw_legend(Image& image, double right, double y, std::span<const LegendEntry> entries, std::span<const std::size_t> rows,
                 double cap_height);

/// How the axes of space lie in the picture: arrows from (x, y) with their names; an axis towards the eye is a dot in a ring, one away
/// from it a cross in a ring. `reach` [px]: length of an axis that lies in the picture.
void draw_triad(Image& image, double x, double y, double reach, const Camera& camera, double cap_height);

/// A number as people write it: no needless digits, at most `digits` significant ones.
std::string short_number(double value, int digits = 4);

/// Units of a text as people write them: µm, µm², µm³, µN, ° for um, um^2, um^3, uN, deg.
std::string display_text(std::string_view text);

/// A time with the unit that suits it and three digits: "40 s", "5.33 min", "36 h".
std::string short_time(double seconds);

}  // namespace morula::scenarios
