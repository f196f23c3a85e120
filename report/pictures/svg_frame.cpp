#include "report/pictures/svg_frame.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "report/pictures/annotate.h"
#include "report/pictures/palette.h"

namespace morula::scenarios {
namespace {

// Two decimals of a pixel, no needless zeros.
std::string px(double value) {
  char buffer[48];
  const double rounded = std::round(value * 100.0) / 100.0;
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, rounded == 0.0 ? 0.0 : rounded).ptr};
}

std::string color_text(int color) {
  // Darker than in pictures of cells: thin lines need contrast on white and on black. No yellow: it has none on white.
  static constexpr int kOrder[] = {5, 6, 2, 3, 1, 0};
  constexpr Rgb kGrey{0.45f, 0.48f, 0.53f};
  const Rgb c = color % 7 == 6 ? kGrey : categorical_color(static_cast<std::size_t>(kOrder[color % 7]));
  char buffer[8];
  std::snprintf(buffer, sizeof buffer, "#%02x%02x%02x", static_cast<unsigned>(c.r * 255.0f + 0.5f),
                static_cast<unsigned>(c.g * 255.0f + 0.5f), static_cast<unsigned>(c.b * 255.0f + 0.5f));
  return buffer;
}

std::string axis_title(const CurveAxis& axis) { return axis.unit.empty() ? axis.label : axis.label + " [" + display_text(axis.unit) + "]"; }

double position(double value, const Ticks& ticks, bool logarithmic) {
  if (!logarithmic) return (value - ticks.low) / (ticks.high - ticks.low);
  return std::log10(value / ticks.low) / std::log10(ticks.high / ticks.low);
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' && c != '\r')
          out += "\xEF\xBF\xBD";
        else
          out += c;
    }
  }
  return out;
}

namespace {

constexpr double kLegendRow = 18.0;
constexpr double kTitleRow = 19.0;
double legend_width(const std::string& name) { return 7.0 * static_cast<double>(name.size()) + 34.0; }

/// The title in lines of at most this many characters, broken at spaces.
std::vector<std::string> title_lines(const std::string& title, std::size_t most) {
  std::vector<std::string> lines;
  std::istringstream words(title);
  for (std::string word; words >> word;) {
    if (lines.empty() || lines.back().size() + 1 + word.size() > most)
      lines.push_back(word);
    else
      lines.back() += ' ' + word;
  }
  return lines;
}

/// How many rows a legend takes between these places.
int legend_rows(const std::vector<PlotEntry>& entries, double left, double right) {
  if (entries.empty()) return 0;
  int rows = 1;
  double at = left;
  for (const PlotEntry& entry : entries) {
    if (at > left && at + legend_width(entry.name) > right) at = left, ++rows;
    at += legend_width(entry.name);
  }
  return rows;
}

}  // namespace

SvgFrame::SvgFrame(const std::string& title, int width, int height, SvgUse use, std::vector<PlotEntry> legend_entries, double room_for_ends)
    : legend_(std::move(legend_entries)), right_(width - 18.0) {
  for (PlotEntry& entry : legend_) entry.name = display_text(entry.name);
  const std::vector<std::string> lines = title_lines(display_text(title), static_cast<std::size_t>((width - 32.0) / 8.3));
  const double extra =
      kLegendRow * legend_rows(legend_, left_, right_) + kTitleRow * std::max(0.0, static_cast<double>(lines.size()) - 1.0);
  height_ = height + static_cast<int>(extra);
  top_ = (lines.empty() ? 18.0 : 38.0) + extra;
  bottom_ = height_ - 50.0;
  out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + std::to_string(width) + " " + std::to_string(height_) +
         "\" width=\"" + std::to_string(width) + "\" height=\"" + std::to_string(height_) +
         "\" role=\"img\" font-family=\"system-ui, 'Helvetica Neue', Arial, sans-serif\"" +
         (use == SvgUse::kFile ? " style=\"color:#22252b\"" : "") + ">\n";
  if (!title.empty()) out_ += "<title>" + xml_escaped(display_text(title)) + "</title>\n";
  if (use == SvgUse::kFile) out_ += "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";  // a style is read by browsers only
  for (std::size_t i = 0; i < lines.size(); ++i)
    text(16.0, 22.0 + kTitleRow * static_cast<double>(i), lines[i], "start", 15.0, " font-weight=\"600\"");
  this->legend();
  right_ -= room_for_ends;
}

void SvgFrame::text(double x, double y, const std::string& content, const char* anchor, double size, const std::string& more) {
  out_ += "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" + anchor + "\" font-size=\"" + px(size) +
          "\" fill=\"currentColor\"" + more + ">" + xml_escaped(content) + "</text>\n";
}

void SvgFrame::axes(const CurveAxis& x_axis, const CurveAxis& y_axis, const Ticks& along, const Ticks& upwards) {
  along_ = along;
  upwards_ = upwards;
  log_x_ = x_axis.logarithmic;
  log_y_ = y_axis.logarithmic;
  for (std::size_t i = 0; i < upwards.at.size(); ++i) {
    const double at = y(upwards.at[i]);
    out_ += "<path d=\"M" + px(left_) + " " + px(at) + "H" + px(right_) + "\" stroke=\"currentColor\" stroke-opacity=\"0.14\"/>\n";
    text(left_ - 8.0, at + 4.0, upwards.text[i], "end", 12.0);
  }
  double free_from = -1e300;  // numbers along the axis never touch
  for (std::size_t i = 0; i < along.at.size(); ++i) {
    const double at = x(along.at[i]), half = 3.5 * static_cast<double>(along.text[i].size());
    out_ += "<path d=\"M" + px(at) + " " + px(bottom_) + "v5\" stroke=\"currentColor\"/>\n";
    if (at - half < free_from) continue;
    text(at, bottom_ + 19.0, along.text[i], "middle", 12.0);
    free_from = at + half + 6.0;
  }
  out_ +=
      "<path d=\"M" + px(left_) + " " + px(top_) + "V" + px(bottom_) + "H" + px(right_) + "\" fill=\"none\" stroke=\"currentColor\"/>\n";
  text(0.5 * (left_ + right_), height_ - 11.0, axis_title(x_axis), "middle", 13.0);
  text(16.0, 0.5 * (top_ + bottom_), axis_title(y_axis), "middle", 13.0,
       " transform=\"rotate(-90 16 " + px(0.5 * (top_ + bottom_)) + ")\"");
}

double SvgFrame::x(double value) const { return left_ + position(value, along_, log_x_) * (right_ - left_); }
double SvgFrame::y(double value) const { return bottom_ - std::clamp(position(value, upwards_, log_y_), -0.05, 1.05) * (bottom_ - top_); }

bool SvgFrame::defined(double x_value, double y_value) const {
  return std::isfinite(x_value) && std::isfinite(y_value) && (!log_x_ || x_value > 0.0) && (!log_y_ || y_value > 0.0);
}
bool SvgFrame::shows(double x_value, double y_value) const {
  return defined(x_value, y_value) && x_value >= along_.low && x_value <= along_.high && y_value >= upwards_.low &&
         y_value <= upwards_.high;
}

void SvgFrame::polyline(const std::vector<std::pair<double, double>>& points, int color) {
  std::vector<std::pair<double, double>> run;
  const auto flush = [&] {
    if (run.size() > 1) line(run, color);
    run.clear();
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto [ax, ay] = points[i - 1];
    const auto [bx, by] = points[i];
    const double to_left = bx != ax ? (left_ - ax) / (bx - ax) : ax < left_ ? 2.0 : 0.0;  // parts of the way where it crosses the borders
    const double to_right = bx != ax ? (right_ - ax) / (bx - ax) : ax > right_ ? -1.0 : 1.0;
    const double from = std::max(0.0, std::min(to_left, to_right)), to = std::min(1.0, std::max(to_left, to_right));
    if (from > to) {
      flush();
      continue;
    }
    const auto at = [ax = ax, ay = ay, bx = bx, by = by](double t) { return std::pair(ax + t * (bx - ax), ay + t * (by - ay)); };
    if (from > 0.0) flush();
    if (run.empty()) run.push_back(at(from));
    run.push_back(to < 1.0 ? at(to) : points[i]);
    if (to < 1.0) flush();
  }
  flush();
}

void SvgFrame::line(const std::vector<std::pair<double, double>>& points, int color) {
  out_ += "<polyline fill=\"none\" stroke=\"" + color_text(color) +
          "\" stroke-width=\"2\" stroke-linejoin=\"round\" stroke-linecap=\"round\" points=\"";
  for (std::size_t i = 0; i < points.size(); ++i)
    out_.append(i ? " " : "").append(px(points[i].first)).append(",").append(px(points[i].second));
  out_ += "\"/>\n";
}

void SvgFrame::point(double x_px, double y_px, int color) {
  out_ += "<circle cx=\"" + px(x_px) + "\" cy=\"" + px(y_px) + "\" r=\"3\" fill=\"" + color_text(color) + "\" fill-opacity=\"0.8\"/>\n";
}

void SvgFrame::bar(double from, double to, double height, int color) {
  const double a = y(0.0), b = y(height);
  out_ += "<rect x=\"" + px(x(from)) + "\" y=\"" + px(std::min(a, b)) + "\" width=\"" + px(x(to) - x(from)) + "\" height=\"" +
          px(std::abs(a - b)) + "\" fill=\"" + color_text(color) + "\" fill-opacity=\"0.85\"/>\n";
}

void SvgFrame::limit(const CurveLimit& limit) {
  if (!std::isfinite(limit.value) || (log_y_ && limit.value <= 0.0)) return;
  const double at = y(limit.value);
  out_ += "<path d=\"M" + px(left_) + " " + px(at) + "H" + px(right_) +
          "\" stroke=\"#c0392b\" stroke-width=\"1.5\" stroke-dasharray=\"7 5\"/>\n";
  out_ += "<text x=\"" + px(right_ - 4.0) + "\" y=\"" + px(at - 5.0) +
          "\" text-anchor=\"end\" font-size=\"12\" fill=\"#c0392b\" stroke=\"#fff\" stroke-opacity=\"0.85\" stroke-width=\"4\" "
          "paint-order=\"stroke\">" +
          xml_escaped(display_text(limit.text)) + "</text>\n";
}

bool SvgFrame::line_ends(std::vector<LineEnd> ends) {
  constexpr double kGap = 14.0, kFarthest = 24.0;
  if (!place_line_ends(ends, top_ + 4.0, bottom_ - 4.0, kGap, kFarthest)) return false;
  for (const LineEnd& end : ends) {
    out_ += "<path d=\"M" + px(right_ + 1.0) + " " + px(end.y) + "L" + px(right_ + 8.0) + " " + px(end.at) +
            "h6\" fill=\"none\" stroke=\"" + color_text(end.color) + "\" stroke-width=\"2\"/>\n";
    text(right_ + 17.0, end.at + 4.0, display_text(end.name), "start", 12.0);
  }
  return true;
}

void SvgFrame::legend() {
  double at = left_, row = top_ - kLegendRow * legend_rows(legend_, left_, right_) + 4.0;
  for (const PlotEntry& entry : legend_) {
    if (at > left_ && at + legend_width(entry.name) > right_) at = left_, row += kLegendRow;
    if (entry.points)
      point(at + 8.0, row - 4.0, entry.color);
    else
      out_ += "<path d=\"M" + px(at) + " " + px(row - 4.0) + "h16\" stroke=\"" + color_text(entry.color) +
              "\" stroke-width=\"4\" stroke-linecap=\"round\"/>\n";
    text(at + 22.0, row, entry.name, "start", 12.0);
    at += legend_width(entry.name);
  }
}

void SvgFrame::no_data() { text(0.5 * (left_ + right_), 0.5 * (top_ + bottom_), "no data", "middle", 14.0, " fill-opacity=\"0.6\""); }

std::string SvgFrame::finish() { return std::move(out_) + "</svg>\n"; }

}  // namespace morula::scenarios
