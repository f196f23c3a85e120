#include "report/pictures/font.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

namespace morula::scenarios {
namespace {

// One glyph on a grid where capitals are 7 high, small letters 5, the baseline is 0 and y points up. A path is a list of strokes
// separated by `;`: a polyline `x y x y …`, or an elliptic arc `@ cx cy rx ry from to` in degrees, counter-clockwise from +x.
struct Glyph {
  char32_t code;
  double advance;
  const char* path;
};

constexpr std::array kGlyphs = {
    Glyph{' ', 2.6, ""},
    Glyph{'!', 2.0, "0.5 7 0.5 2.2;0.5 0.1 0.5 0"},
    Glyph{'"', 3.2, "0.5 7 0.5 5;2 7 2 5"},
    Glyph{'#', 5.6, "1.5 0 2.2 7;3.2 0 3.9 7;0.4 2.3 4.9 2.3;0.6 4.7 5.1 4.7"},
    Glyph{'$', 5.2, "2.2 -1 2.2 8;@ 2.2 5.1 1.9 1.6 30 270;@ 2.2 1.9 1.9 1.6 -150 90"},
    Glyph{'%', 7.0, "1.2 0 5 7;@ 1.3 5.6 1.1 1.4 0 360;@ 4.9 1.4 1.1 1.4 0 360"},
    Glyph{'&', 6.0, "5.2 0 1.2 4.8;@ 2.2 5.6 1.2 1.4 -35 215;@ 2 1.9 1.9 1.9 110 320;3.4 0.6 4.8 2.8"},
    Glyph{'\'', 1.8, "0.5 7 0.5 5"},
    Glyph{'(', 2.8, "@ 3 3 2.5 5 130 230"},
    Glyph{')', 2.8, "@ -0.7 3 2.5 5 -50 50"},
    Glyph{'*', 4.2, "1.7 7 1.7 3.6;0.2 6.2 3.2 4.4;3.2 6.2 0.2 4.4"},
    Glyph{'+', 5.0, "2.2 1 2.2 5;0.2 3 4.2 3"},
    Glyph{',', 2.0, "0.7 0.2 0.2 -1.3"},
    Glyph{'-', 3.4, "0.4 2.6 2.5 2.6"},
    Glyph{'.', 2.0, "0.5 0.1 0.5 0"},
    Glyph{'/', 3.6, "0 -0.6 2.8 7.4"},
    Glyph{'0', 5.2, "@ 2.1 3.5 2 3.5 0 360"},
    Glyph{'1', 5.2, "0.8 5.6 2.5 7 2.5 0"},
    Glyph{'2', 5.2, "@ 2.1 5 1.9 2 -30 170;3.75 4 0.1 0 4.1 0"},
    Glyph{'3', 5.2, "@ 2 5.3 1.7 1.7 -90 155;@ 2 1.85 2 1.8 -160 90;1.4 3.62 2 3.62"},
    Glyph{'4', 5.2, "3.2 0 3.2 7 0 2 4.3 2"},
    Glyph{'5', 5.2, "3.8 7 0.7 7 0.4 3.8;@ 2 2.25 2.05 2.25 -155 138"},
    Glyph{'6', 5.2, "@ 2.15 2.2 2 2.2 0 360;@ 4.2 2.2 4.05 4.9 100 180"},
    Glyph{'7', 5.2, "0.1 7 4.1 7 1.4 0"},
    Glyph{'8', 5.2, "@ 2.1 5.3 1.7 1.7 0 360;@ 2.1 1.8 2 1.8 0 360"},
    Glyph{'9', 5.2, "@ 2.05 4.8 2 2.2 0 360;@ 0 4.8 4.05 4.9 -80 0"},
    Glyph{':', 2.0, "0.5 0.1 0.5 0;0.5 4.1 0.5 4"},
    Glyph{';', 2.0, "0.7 0.2 0.2 -1.3;0.7 4.1 0.7 4"},
    Glyph{'<', 4.8, "4 5.2 0.4 3 4 0.8"},
    Glyph{'=', 5.0, "0.2 2.1 4.2 2.1;0.2 4.1 4.2 4.1"},
    Glyph{'>', 4.8, "0.4 5.2 4 3 0.4 0.8"},
    Glyph{'?', 4.4, "@ 1.8 5.3 1.7 1.7 -50 165;2.9 4 1.8 3 1.8 2.2;1.8 0.1 1.8 0"},
    Glyph{'@', 7.4, "@ 3.2 3 3.2 3.6 -50 290;@ 3.2 3 1.5 1.6 0 360;4.7 4.6 4.7 2.2;@ 5.55 2.2 0.85 0.9 180 360"},
    Glyph{'A', 5.6, "0 0 2.4 7 4.8 0;0.8 2.3 4 2.3"},
    Glyph{'B', 5.5, "0.4 0 0.4 7 2.4 7;@ 2.4 5.3 1.7 1.7 -90 90;0.4 3.6 2.6 3.6;@ 2.6 1.8 1.8 1.8 -90 90;2.6 0 0.4 0"},
    Glyph{'C', 5.8, "@ 3 3.5 2.8 3.5 45 315"},
    Glyph{'D', 5.9, "2.2 0 0.4 0 0.4 7 2.2 7;@ 2.2 3.5 2.8 3.5 -90 90"},
    Glyph{'E', 5.0, "4.1 0 0.4 0 0.4 7 4.1 7;0.4 3.7 3.5 3.7"},
    Glyph{'F', 4.7, "0.4 0 0.4 7 4 7;0.4 3.6 3.4 3.6"},
    Glyph{'G', 6.0, "@ 3 3.5 2.8 3.5 45 325;5.3 1.5 5.3 3.2 3.2 3.2"},
    Glyph{'H', 5.9, "0.4 0 0.4 7;4.7 0 4.7 7;0.4 3.7 4.7 3.7"},
    Glyph{'I', 1.9, "0.5 0 0.5 7"},
    Glyph{'J', 4.4, "3.2 7 3.2 1.6;@ 1.6 1.6 1.6 1.6 180 360"},
    Glyph{'K', 5.4, "0.4 0 0.4 7;4.4 7 0.4 2.6;1.8 4.1 4.7 0"},
    Glyph{'L', 4.6, "0.4 7 0.4 0 3.9 0"},
    Glyph{'M', 6.8, "0.4 0 0.4 7 3 1.6 5.6 7 5.6 0"},
    Glyph{'N', 6.0, "0.4 0 0.4 7 4.8 0 4.8 7"},
    Glyph{'O', 6.4, "@ 2.8 3.5 2.8 3.5 0 360"},
    Glyph{'P', 5.2, "0.4 0 0.4 7 2.4 7;@ 2.4 5.15 1.85 1.85 -90 90;2.4 3.3 0.4 3.3"},
    Glyph{'Q', 6.4, "@ 2.8 3.5 2.8 3.5 0 360;3.4 1.8 5.4 -0.6"},
    Glyph{'R', 5.5, "0.4 0 0.4 7 2.4 7;@ 2.4 5.2 1.8 1.8 -90 90;2.4 3.4 0.4 3.4;2.4 3.4 4.5 0"},
    Glyph{'S', 5.2, "@ 2.1 5.2 1.85 1.8 25 270;@ 2.1 1.75 2.05 1.75 -155 92"},
    Glyph{'T', 5.2, "0 7 4.6 7;2.3 7 2.3 0"},
    Glyph{'U', 5.8, "0.4 7 0.4 2.2;4.6 7 4.6 2.2;@ 2.5 2.2 2.1 2.2 180 360"},
    Glyph{'V', 5.3, "0 7 2.3 0 4.6 7"},
    Glyph{'W', 7.6, "0 7 1.7 0 3.5 6 5.2 0 6.9 7"},
    Glyph{'X', 5.2, "0 0 4.4 7;0 7 4.4 0"},
    Glyph{'Y', 5.2, "0 7 2.3 3.4 4.6 7;2.3 3.4 2.3 0"},
    Glyph{'Z', 5.2, "0.1 7 4.4 7 0 0 4.5 0"},
    Glyph{'[', 2.8, "2.1 7.6 0.6 7.6 0.6 -1.4 2.1 -1.4"},
    Glyph{'\\', 3.6, "0 7.4 2.8 -0.6"},
    Glyph{']', 2.8, "0.2 7.6 1.7 7.6 1.7 -1.4 0.2 -1.4"},
    Glyph{'^', 4.4, "0.4 4.4 2 7 3.6 4.4"},
    Glyph{'_', 5.0, "0 -1 4.6 -1"},
    Glyph{'`', 2.4, "0.4 7 1.4 5.8"},
    Glyph{'a', 4.9, "@ 2 2.4 1.9 2.4 0 360;3.9 4.8 3.9 0"},
    Glyph{'b', 4.9, "0.4 0 0.4 7;@ 2.3 2.4 1.9 2.4 0 360"},
    Glyph{'c', 4.3, "@ 2.1 2.4 2 2.4 48 312"},
    Glyph{'d', 4.9, "3.9 0 3.9 7;@ 2 2.4 1.9 2.4 0 360"},
    Glyph{'e', 4.7, "@ 2.1 2.4 2 2.4 0 318;0.1 2.5 4.1 2.5"},
    Glyph{'f', 2.9, "1 0 1 5.6;@ 2.3 5.6 1.3 1.5 80 180;0 4.7 2.4 4.7"},
    Glyph{'g', 4.9, "@ 2 2.4 1.9 2.4 0 360;3.9 4.8 3.9 -0.4;@ 2.1 -0.4 1.8 1.7 205 360"},
    Glyph{'h', 4.8, "0.4 0 0.4 7;@ 2.1 3 1.7 1.8 0 180;3.8 3 3.8 0"},
    Glyph{'i', 1.8, "0.5 0 0.5 4.8;0.5 6.7 0.5 6.6"},
    Glyph{'j', 2.0, "0.9 4.8 0.9 -0.6;@ -0.3 -0.6 1.2 1.4 270 360;0.9 6.7 0.9 6.6"},
    Glyph{'k', 4.5, "0.4 0 0.4 7;3.6 4.8 0.4 1.8;1.6 2.9 3.9 0"},
    Glyph{'l', 1.9, "0.5 0 0.5 7"},
    Glyph{'m', 7.2, "0.4 0 0.4 4.8;@ 1.85 3.2 1.45 1.6 0 180;3.3 3.2 3.3 0;@ 4.75 3.2 1.45 1.6 0 180;6.2 3.2 6.2 0"},
    Glyph{'n', 4.8, "0.4 0 0.4 4.8;@ 2.1 3 1.7 1.8 0 180;3.8 3 3.8 0"},
    Glyph{'o', 4.9, "@ 2.1 2.4 2 2.4 0 360"},
    Glyph{'p', 4.9, "0.4 -2.1 0.4 4.8;@ 2.3 2.4 1.9 2.4 0 360"},
    Glyph{'q', 4.9, "3.9 -2.1 3.9 4.8;@ 2 2.4 1.9 2.4 0 360"},
    Glyph{'r', 3.2, "0.4 0 0.4 4.8;@ 2.2 2.9 1.8 1.9 80 180"},
    Glyph{'s', 4.3, "@ 1.8 3.6 1.5 1.2 25 270;@ 1.8 1.2 1.7 1.2 -155 92"},
    Glyph{'t', 3.1, "1 6.4 1 1.3;@ 2.1 1.3 1.1 1.3 180 290;0 4.7 2.4 4.7"},
    Glyph{'u', 4.8, "0.4 4.8 0.4 1.8;@ 2.1 1.8 1.7 1.8 180 360;3.8 4.8 3.8 0"},
    Glyph{'v', 4.3, "0.1 4.8 1.9 0 3.7 4.8"},
    Glyph{'w', 6.2, "0.1 4.8 1.4 0 2.8 4.2 4.2 0 5.5 4.8"},
    Glyph{'x', 4.2, "0.1 0 3.5 4.8;0.1 4.8 3.5 0"},
    Glyph{'y', 4.3, "0.1 4.8 1.95 0;3.7 4.8 1.3 -1.6 0.3 -2.1"},
    Glyph{'z', 4.2, "0.2 4.8 3.5 4.8 0.1 0 3.6 0"},
    Glyph{'{', 3.0, "2.3 7.6 1.4 7.2 1.4 3.8 0.5 3.1 1.4 2.4 1.4 -1 2.3 -1.4"},
    Glyph{'|', 1.8, "0.5 7.8 0.5 -1.6"},
    Glyph{'}', 3.0, "0.3 7.6 1.2 7.2 1.2 3.8 2.1 3.1 1.2 2.4 1.2 -1 0.3 -1.4"},
    Glyph{'~', 5.0, "@ 1.2 2.6 1 0.9 0 180;@ 3.2 2.6 1 0.9 180 360"},
    Glyph{U'\u00B5', 5.0, "0.5 4.8 0.5 -2.1;@ 2.1 1.7 1.6 1.7 180 360;3.7 4.8 3.7 1;@ 4.5 1 0.8 0.9 180 270"},
    Glyph{U'\u03BC', 5.0, "0.5 4.8 0.5 -2.1;@ 2.1 1.7 1.6 1.7 180 360;3.7 4.8 3.7 1;@ 4.5 1 0.8 0.9 180 270"},
    Glyph{U'\u00B7', 2.2, "0.7 2.9 0.7 2.8"},
    Glyph{U'\u00D7', 4.6, "0.6 1.4 3.6 4.4;0.6 4.4 3.6 1.4"},
    Glyph{U'\u00B0', 3.4, "@ 1.4 5.8 1.2 1.2 0 360"},
    Glyph{U'\u2013', 4.6, "0.2 2.6 3.9 2.6"},
    Glyph{U'\u2212', 5.0, "0.2 3 4.2 3"},
    Glyph{U'\u00B9', 2.4, "0.2 6.6 1.1 7.4 1.1 3.8"},
    Glyph{U'\u00B2', 3.0, "@ 1.1 6.4 1 1 -30 170;1.95 5.9 0.1 3.8 2.2 3.8"},
    Glyph{U'\u00B3', 3.0, "@ 1 6.5 0.9 0.9 -90 150;@ 1 4.7 1 0.95 -150 90"},
    Glyph{U'\u207B', 2.8, "0.2 5.6 2 5.6"},
    Glyph{U'\uFFFD', 4.6, "0.4 0 3.6 0 3.6 6 0.4 6 0.4 0"}};

struct Segment {
  double x0, y0, x1, y1;
};

const Glyph& glyph_of(char32_t code) {
  for (const Glyph& glyph : kGlyphs)
    if (glyph.code == code) return glyph;
  return kGlyphs.back();
}

// Next code point of UTF-8 text; a byte that is not UTF-8 becomes U+FFFD.
char32_t next_code(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at);
  const std::size_t length = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
  if (length == 0 || at + length > text.size()) return ++at, U'\uFFFD';
  char32_t code = length == 1 ? first : first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0) != 0x80) return ++at, U'\uFFFD';
    code = (code << 6) | (byte(at + i) & 0x3F);
  }
  at += length;
  return code;
}

void add_arc(const double* a, std::vector<Segment>& out) {
  constexpr int kPieces = 24;
  const auto point = [&](int i) {
    const double angle = (a[4] + (a[5] - a[4]) * i / kPieces) * std::numbers::pi / 180.0;
    return std::array{a[0] + a[2] * std::cos(angle), a[1] + a[3] * std::sin(angle)};
  };
  for (int i = 0; i < kPieces; ++i) {
    const auto p = point(i), q = point(i + 1);
    out.push_back({p[0], p[1], q[0], q[1]});
  }
}

std::vector<Segment> strokes_of(const Glyph& glyph) {
  std::vector<Segment> out;
  const std::string path = glyph.path;
  for (std::size_t begin = 0; begin < path.size();) {
    const std::size_t end = std::min(path.find(';', begin), path.size());
    std::string stroke = path.substr(begin, end - begin);
    begin = end + 1;
    const bool arc = stroke[0] == '@';
    if (arc) stroke[0] = ' ';
    std::vector<double> numbers;
    const char* cursor = stroke.c_str();
    for (char* after = nullptr;; cursor = after) {
      const double value = std::strtod(cursor, &after);
      if (after == cursor) break;
      numbers.push_back(value);
    }
    if (arc)
      add_arc(numbers.data(), out);
    else
      for (std::size_t i = 0; i + 3 < numbers.size(); i += 2) out.push_back({numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]});
  }
  return out;
}

double distance_to(const Segment& s, double x, double y) {
  const double dx = s.x1 - s.x0, dy = s.y1 - s.y0, length2 = dx * dx + dy * dy;
  const double t = length2 > 0.0 ? std::clamp(((x - s.x0) * dx + (y - s.y0) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(x - s.x0 - t * dx, y - s.y0 - t * dy);
}

void draw_glyph(Image& image, double x, double y, const Glyph& glyph, double scale, const Rgb& color) {
  const auto strokes = strokes_of(glyph);
  if (strokes.empty()) return;
  const double half_width = std::max(0.62, 0.46 * scale);  // [px]
  for (int row = static_cast<int>(std::floor(y - 8.5 * scale)); row <= static_cast<int>(std::ceil(y + 3.0 * scale)); ++row) {
    for (int column = static_cast<int>(std::floor(x - scale)); column <= static_cast<int>(std::ceil(x + (glyph.advance + 1.0) * scale));
         ++column) {
      double nearest = 1e9;
      for (const Segment& s : strokes) nearest = std::min(nearest, distance_to(s, (column + 0.5 - x) / scale, (y - row - 0.5) / scale));
      image.blend(column, row, color, static_cast<float>(std::clamp(half_width + 0.5 - nearest * scale, 0.0, 1.0)));
    }
  }
}

}  // namespace

constexpr double kLetterSpacing = 0.35;  // between glyphs, on their grid

double text_width(std::string_view text, double cap_height) {
  double width = 0.0;
  for (std::size_t at = 0; at < text.size();) width += glyph_of(next_code(text, at)).advance + kLetterSpacing;
  return width * cap_height / 7.0;
}

void draw_text(Image& image, double x, double y, std::string_view text, double cap_height, const Rgb& color, Align align) {
  const double scale = cap_height / 7.0;
  if (align != Align::kLeft) x -= text_width(text, cap_height) * (align == Align::kCenter ? 0.5 : 1.0);
  for (std::size_t at = 0; at < text.size();) {
    const Glyph& glyph = glyph_of(next_code(text, at));
    draw_glyph(image, x + 0.3 * scale, y, glyph, scale, color);
    x += (glyph.advance + kLetterSpacing) * scale;
  }
}

}  // namespace morula::scenarios
