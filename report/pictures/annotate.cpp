#include "report/pictures/annotate.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string>

#include "report/pictures/camera.h"
#include "report/pictures/font.h"

namespace morula::scenarios {
namespace {

constexpr Rgb kInk{0.13f, 0.14f, 0.18f};
constexpr double kRoundSteps[] = {1.0, 2.0, 2.5, 3.0, 4.0, 5.0};
constexpr double kDot = 1.9, kEntryGap = 1.5;  // of a legend's entry: from its left end to the text, and from the text to the next

double entry_width(const LegendEntry& entry, double cap_height) {
  return text_width(entry.text, cap_height) + (kDot + kEntryGap) * cap_height;
}

/// Least and largest value, rounded to three digits of the larger of the two.
std::string data_range(const ColorScale& scale) {
  const double low = scale.data_low * scale.per_unit, high = scale.data_high * scale.per_unit;
  const double size = std::max(std::abs(low), std::abs(high));
  if (!(size > 0.0)) return "0 to 0";
  const double digit = std::pow(10.0, std::floor(std::log10(size)) - 2.0);
  const auto rounded = [&](double value) { return short_number(std::round(value / digit) * digit, 3); };
  return rounded(low) + " to " + rounded(high);
}

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
  static constexpr std::pair<std::string_view, std::string_view> kWords[] = {{"um", "µm"}, {"uN", "µN"}, {"deg", "°"}};
  std::string out;
  const auto letter = [&](std::size_t i) {
    return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_');
  };
  for (std::size_t i = 0; i < text.size();) {
    const auto* word = std::find_if(std::begin(kWords), std::end(kWords), [&](const auto& w) {
      return text.substr(i).starts_with(w.first) && !(i > 0 && letter(i - 1)) && !letter(i + w.first.size());
    });
    if (word != std::end(kWords)) {
      out += word->second;
      i += word->first.size();
    } else if (text[i] == '^' && (text.substr(i + 1, 1) == "2" || text.substr(i + 1, 1) == "3")) {
      out += text[i + 1] == '2' ? "²" : "³";
      i += 2;
    } else {
      out += text[i++];
    }
  }
  return out;
}

std::string short_time(double seconds) {
  const double size = std::abs(seconds);
  const auto text = [](double value, const char* unit) { return short_number(value, std::abs(value) < 100.0 ? 3 : 4) + unit; };
  return size < 120.0 ? text(seconds, " s") : size < 7200.0 ? text(seconds / 60.0, " min") : text(seconds / 3600.0, " h");
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

std::vector<double> color_bar_numbers(const ColorScale& scale) {
  const double low = scale.low * scale.per_unit, high = scale.high * scale.per_unit, span = high - low;
  for (const int intervals : {4, 5, 3, 6, 2}) {
    const double step = span / intervals, decade = std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    const auto whole = [](double ratio) { return std::abs(ratio - std::round(ratio)) < 1e-6; };
    const bool round =
        std::any_of(std::begin(kRoundSteps), std::end(kRoundSteps), [&](double s) { return std::abs(step / decade - s) < 1e-6; });
    if (!round || !whole(low / step)) continue;
    std::vector<double> out;
    for (int i = 0; i <= intervals; ++i) out.push_back((std::round(low / step) + i) * step / scale.per_unit);
    return out;
  }
  if (scale.diverging) return {scale.low, 0.0, scale.high};
  return {scale.low, scale.high};
}

void draw_color_bar(Image& image, double right, double y, double width, const ColorScale& scale, double cap_height) {
  const double height = 1.1 * cap_height, left = right - width;
  for (int x = static_cast<int>(left); x < static_cast<int>(right); ++x)
    image.fill_rectangle(x, y - height, x + 1, y, scale_color(scale, scale.low + (scale.high - scale.low) * (x + 0.5 - left) / width));
  for (const double edge : {y - height, y - 1.0}) image.fill_rectangle(left, edge, right, edge + 1.0, kInk, 0.6f);
  for (const double edge : {left, right - 1.0}) image.fill_rectangle(edge, y - height, edge + 1.0, y, kInk, 0.6f);

  const double small = 0.9 * cap_height;
  double free_from = -1e300;  // numbers never touch
  for (const double value : color_bar_numbers(scale)) {
    const double x = std::clamp(left + (value - scale.low) / (scale.high - scale.low) * width, left + 0.5, right - 0.5);
    image.fill_rectangle(x - 0.5, y, x + 0.5, y + 4.0, kInk);
    const std::string text = short_number(value * scale.per_unit);
    const double half = 0.5 * text_width(text, small);
    if (x - half < free_from) continue;
    draw_text(image, x, y + 7.0 + small, text, small, kInk, Align::kCenter);
    free_from = x + half + small;
  }
  if (scale.data_low <= scale.data_high)
    draw_text(image, 0.5 * (left + right), y + 7.0 + 2.6 * small, "data " + data_range(scale), small, kInk, Align::kCenter);
  const std::string title = scale.unit.empty() ? scale.quantity : scale.quantity + " [" + scale.unit + "]";
  draw_text(image, 0.5 * (left + right), y - height - 0.75 * cap_height, title, cap_height, kInk, Align::kCenter);
}

std::vector<std::size_t> legend_rows(std::span<const LegendEntry> entries, double first_width, double width, double cap_height) {
  std::vector<std::size_t> rows;
  double room = first_width;
  for (const LegendEntry& entry : entries) {
    const double needed = entry_width(entry, cap_height);
    if (rows.empty() || (needed > room && rows.back() > 0)) {
      room = rows.empty() ? first_width : width;
      rows.push_back(0);
    }
    if (rows.size() == 1 && rows.back() == 0 && needed > room) room = width, rows.push_back(0);  // none fits beside the title
    ++rows.back();
    room -= needed;
  }
  return rows;
}

void draw_legend(Image& image, double right, double y, std::span<const LegendEntry> entries, std::span<const std::size_t> rows,
                 double cap_height) {
  for (const std::size_t count : rows) {
    double x = right + kEntryGap * cap_height;
    for (const LegendEntry& entry : entries.first(count)) x -= entry_width(entry, cap_height);
    for (const LegendEntry& entry : entries.first(count)) {
      image.fill_disc(x + 0.62 * cap_height, y + 0.5 * cap_height, 0.62 * cap_height, kInk);
      image.fill_disc(x + 0.62 * cap_height, y + 0.5 * cap_height, 0.62 * cap_height - 1.2, entry.color);
      draw_text(image, x + kDot * cap_height, y + cap_height, entry.text, cap_height, kInk);
      x += entry_width(entry, cap_height);
    }
    entries = entries.subspan(count);
    y += kLegendLine * cap_height;
  }
}

void draw_triad(Image& image, double x, double y, double reach, const Camera& camera, double cap_height) {
  const double line = std::max(1.5, 0.14 * cap_height), ring = 0.6 * cap_height;
  static constexpr const char* kNames[] = {"x", "y", "z"};
  const auto length_of = [&](std::size_t axis) { return std::hypot(camera.right[axis], camera.up[axis]); };
  std::array<std::size_t, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return length_of(a) > length_of(b); });  // shortest on top
  for (const std::size_t axis : order) {
    const double across = camera.right[axis], up = camera.up[axis], length = length_of(axis);
    if (length < 0.3) {  // nearly along the line of sight
      image.fill_disc(x, y, ring, kInk);
      image.fill_disc(x, y, ring - line, {1.0f, 1.0f, 1.0f});
      const double d = 0.6 * ring;
      if (camera.toward[axis] > 0.0) {
        image.fill_disc(x, y, 1.2 * line, kInk);
      } else {
        image.stroke(x - d, y - d, x + d, y + d, line, kInk);
        image.stroke(x - d, y + d, x + d, y - d, line, kInk);
      }
      draw_text(image, x - 1.1 * cap_height, y + 1.3 * cap_height, kNames[axis], cap_height, kInk, Align::kRight);
      continue;
    }
    const double end_x = x + reach * across, end_y = y - reach * up, ux = across / length, uy = -up / length;
    image.stroke(x, y, end_x, end_y, line, kInk);
    for (const double side : {-1.0, 1.0})
      image.stroke(end_x, end_y, end_x - 0.4 * cap_height * (ux - 0.6 * side * uy), end_y - 0.4 * cap_height * (uy + 0.6 * side * ux), line,
                   kInk);
    draw_text(image, end_x + 0.9 * cap_height * ux, end_y + 0.9 * cap_height * uy + 0.45 * cap_height, kNames[axis], cap_height, kInk,
              Align::kCenter);
  }
}

}  // namespace morula::scenarios
