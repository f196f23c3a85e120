#pragma once
#include <string_view>

#include "report/pictures/image.h"

namespace morula::scenarios {

/// Text in pictures: a stroke font of our own, so that a picture looks the same on every machine and needs no font file.
/// Covers printable ASCII and µ · × ° – ² ³ ¹ ⁻; anything else becomes a small box.
enum class Align { kLeft, kCenter, kRight };

/// Width of a line of UTF-8 text whose capitals are `cap_height` pixels high [px].
double text_width(std::string_view text, double cap_height);

/// Draw a line of text; (x, y) is the left end, centre or right end of its baseline [px, y down].
void draw_text(Image& image, double x, double y, std::string_view text, double cap_height, const Rgb& color, Align align = Align::kLeft);

}  // namespace morula::scenarios
