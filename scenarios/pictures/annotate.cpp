#include "scenarios/pictures/annotate.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string>

#include "scenarios/pictures/camera.h"
#include "scenarios/pictures/font.h"

namespace morula::scenarios {
namespace {

constexpr Rgb kInk{0.13f, 0.14f, 0.18f};

}  // namespace

std::string short_number(double value, int digits) {
  if (value == 0.0) return "0";
  char buffer[48];
  const double size = std::abs(value);
  const bool plain = size < 1e6 && size >= 1e-4;
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr;
  std::string text(buffer, end);
  if (plain && text.find('e') != std::string::npos) {  // general switches to exponents early: 12345 with 4 digits
    const int decimals = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(size))));
    text.assign(buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals).ptr);
  }
  return text;
}

std::string display_text(std::string_view text) {
  std::string out;
  const auto letter = [&](std::size_t i) { return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0; };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.substr(i, 2) == "um" && !(i > 0 && (letter(i - 1) || text[i - 1] == '_')) && !letter(i + 2) && text.substr(i + 2, 1) != "_") {
      out += "µm";
      ++i;
    } else if (text[i] == '^' && (text.substr(i + 1, 1) == "2" || text.substr(i + 1, 1) == "3")) {
      out += text[++i] == '2' ? "²" : "³";
    } else {
      out += text[i];
    }
  }
  return out;
}

std::string short_time(double seconds) {
  if (std::abs(seconds) < 120.0) return short_number(seconds) + " s";
  if (std::abs(seconds) < 7200.0) return short_number(seconds / 60.0) + " min";
  return short_number(seconds / 3600.0) + " h";
}

ScaleBar make_scale_bar(double pixels_per_um, double widest) {
  ScaleBar bar;
  bar.length = nice_below(widest / pixels_per_um);
  bar.pixels = bar.length * pixels_per_um;
  bar.label = bar.length >= 1000.0 ? short_number(bar.length / 1000.0) + " mm"
              : bar.length < 0.5   ? short_number(bar.length * 1000.0) + " nm"
                                   : short_number(bar.length) + " µm";
  return bar;
}

void draw_scale_bar(Image& image, double x, double y, const ScaleBar& bar, double cap_height) {
  const double thickness = std::max(3.0, 0.4 * cap_height);
  image.fill_rectangle(x, y - thickness, x + bar.pixels, y, kInk);
  draw_text(image, x + 0.5 * bar.pixels, y - thickness - 0.75 * cap_height, bar.label, cap_height, kInk, Align::kCenter);
}

void draw_color_bar(Image& image, double right, double y, double width, const ColorScale& scale, double cap_height) {
  const double height = 1.1 * cap_height, left = right - width;
  for (int x = static_cast<int>(left); x < static_cast<int>(right); ++x)
    image.fill_rectangle(x, y - height, x + 1, y, scale_color(scale, scale.low + (scale.high - scale.low) * (x + 0.5 - left) / width));
  for (const double edge : {y - height, y - 1.0}) image.fill_rectangle(left, edge, right, edge + 1.0, kInk, 0.6f);
  for (const double edge : {left, right - 1.0}) image.fill_rectangle(edge, y - height, edge + 1.0, y, kInk, 0.6f);

  const double low = scale.low * scale.per_unit, high = scale.high * scale.per_unit;
  const double step = nice_below((high - low) / 2.0);
  const double small = 0.9 * cap_height;
  const auto tick = [&](double value) {
    const double x = std::clamp(left + (value - low) / (high - low) * width, left + 0.5, right - 0.5);
    image.fill_rectangle(x - 0.5, y, x + 0.5, y + 4.0, kInk);
    draw_text(image, x, y + 7.0 + small, short_number(value), small, kInk, Align::kCenter);
  };
  tick(low);
  tick(high);
  const double room = text_width(short_number(low), small) + text_width(short_number(high), small);
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    if (std::min(i * step - low, high - i * step) / (high - low) * width > room) tick(i * step);  // clear of the numbers at the ends
  if (scale.data_low <= scale.data_high)
    draw_text(image, 0.5 * (left + right), y + 7.0 + 2.6 * small,
              "data " + short_number(scale.data_low * scale.per_unit, 3) + " to " + short_number(scale.data_high * scale.per_unit, 3),
              small, kInk, Align::kCenter);
  const std::string title = scale.unit.empty() ? scale.quantity : scale.quantity + " [" + scale.unit + "]";
  draw_text(image, 0.5 * (left + right), y - height - 0.75 * cap_height, title, cap_height, kInk, Align::kCenter);
}

void draw_legend(Image& image, double right, double y, std::span<const LegendEntry> entries, double cap_height) {
  double widest = 0.0;
  for (const LegendEntry& entry : entries) widest = std::max(widest, text_width(entry.text, cap_height));
  const double text_x = right - widest;
  if (!entries.empty())  // legible over what lies below
    image.fill_rectangle(text_x - 2.4 * cap_height, y - 0.7 * cap_height, right + 0.8 * cap_height,
                         y + (2.1 * static_cast<double>(entries.size()) - 0.3) * cap_height, {1.0f, 1.0f, 1.0f}, 0.8f);
  for (const LegendEntry& entry : entries) {
    image.fill_disc(text_x - 1.3 * cap_height, y + 0.5 * cap_height, 0.62 * cap_height, kInk);
    image.fill_disc(text_x - 1.3 * cap_height, y + 0.5 * cap_height, 0.62 * cap_height - 1.2, entry.color);
    draw_text(image, text_x, y + cap_height, entry.text, cap_height, kInk);
    y += 2.1 * cap_height;
  }
}

}  // namespace morula::scenarios
