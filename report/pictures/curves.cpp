#include "report/pictures/curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/numbers/number_text.h"
#include "report/pictures/annotate.h"
#include "report/pictures/camera.h"
#include "report/pictures/png.h"
#include "report/pictures/svg_frame.h"
#include "results/file_io.h"

namespace morula::scenarios {
namespace {

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

  void add(double value, bool logarithmic) {
    if (!std::isfinite(value) || (logarithmic && value <= 0.0)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] bool empty() const { return !(low <= high); }
};

Ticks ticks_of(const CurveAxis& axis, Range range, int wanted, bool widen) {
  if (range.empty()) range = axis.logarithmic ? Range{1.0, 10.0} : Range{0.0, 1.0};
  // An axis that nearly reaches zero starts there.
  if (!axis.logarithmic && range.low > 0.0 && range.low < 0.4 * range.high) range.low = 0.0;
  if (axis.low) range.low = *axis.low;
  if (axis.high) range.high = *axis.high;
  if (axis.label == "time" && !axis.logarithmic && !widen) return time_ticks(range.low, range.high, wanted, axis.unit);
  return axis.logarithmic ? log_ticks(range.low, range.high, widen) : linear_ticks(range.low, range.high, wanted, widen);
}

void draw_points(SvgFrame& frame, const Curve& curve, int color) {
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i)
    if (frame.shows(curve.x[i], curve.y[i])) frame.point(frame.x(curve.x[i]), frame.y(curve.y[i]), color);
}

void draw_line(SvgFrame& frame, const Curve& curve, int color) {
  std::vector<std::pair<double, double>> run;
  const auto flush = [&] {
    if (run.size() == 1) frame.point(run[0].first, run[0].second, color);
    if (run.size() > 1) frame.polyline(run, color);
    run.clear();
  };
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    if (!frame.defined(curve.x[i], curve.y[i])) {
      flush();
      continue;
    }
    if (curve.style == CurveStyle::kSteps && !run.empty()) run.emplace_back(frame.x(curve.x[i]), run.back().second);
    run.emplace_back(frame.x(curve.x[i]), frame.y(curve.y[i]));
  }
  flush();
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string header(const std::string& name, const std::string& unit) { return csv_field(unit.empty() ? name : name + " [" + unit + "]"); }

// Long form: one row for each point, so that curves need not share their x.
std::string curves_csv(const CurvePlot& plot) {
  std::string out = "curve," + header(plot.x.label, plot.x.unit) + "," + header(plot.y.label, plot.y.unit) + "\n";
  for (const Curve& curve : plot.curves)
    for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i)
      out += csv_field(curve.name) + "," + shortest_text(curve.x[i]) + "," + shortest_text(curve.y[i]) + "\n";
  return out;
}

std::string bars_csv(const BarPlot& plot) {
  std::string out = header(plot.x.label, plot.x.unit);
  for (const BarSeries& series : plot.series) out.append(",").append(header(series.name, plot.y.unit));
  out += "\n";
  for (std::size_t i = 0; i < plot.categories.size(); ++i) {
    out += csv_field(plot.categories[i]);
    for (const BarSeries& series : plot.series)
      out.append(",").append(shortest_text(i < series.heights.size() ? series.heights[i] : std::numeric_limits<double>::quiet_NaN()));
    out += "\n";
  }
  return out;
}

/// Numbers along both axes.
struct PlotTicks {
  Ticks along, upwards;
  bool any = false;  ///< whether there is a point to show
};

PlotTicks ticks_of(const CurvePlot& plot) {
  Range x, y, points;
  PlotTicks out;
  for (const Curve& curve : plot.curves) {
    for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
      if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) continue;
      x.add(curve.x[i], plot.x.logarithmic);
      y.add(curve.y[i], plot.y.logarithmic);
      if (curve.style == CurveStyle::kPoints) points.add(curve.x[i], plot.x.logarithmic);
      out.any = true;
    }
  }
  for (const CurveLimit& limit : plot.limits) y.add(limit.value, plot.y.logarithmic);
  if (!points.empty() && !plot.x.logarithmic && !plot.x.low && !plot.x.high) {  // no point lies on the border, but at zero
    const double rim = 0.03 * (x.high - x.low);
    if (points.low < x.low + rim && x.low != 0.0) x.low -= rim;
    if (points.high > x.high - rim) x.high += rim;
  }
  out.along = ticks_of(plot.x, x, 7, false);
  out.upwards = ticks_of(plot.y, y, 5, true);
  return out;
}

/// A curve whose name is to be told: the first of those that share its colour.
struct Named {
  const Curve* curve;
  int color;
};

int color_of(const CurvePlot& plot, std::size_t c) { return plot.curves[c].color >= 0 ? plot.curves[c].color : static_cast<int>(c); }

std::vector<Named> named_curves(const CurvePlot& plot) {
  std::vector<Named> out;
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    const int color = color_of(plot, c);
    if (std::none_of(out.begin(), out.end(), [&](const Named& n) { return n.color == color; })) out.push_back({&plot.curves[c], color});
  }
  return out;
}

/// Number of the last point of a line that has a place; none: it has no end.
std::optional<std::size_t> end_of(const Curve& curve, const SvgFrame& frame) {
  for (std::size_t i = std::min(curve.x.size(), curve.y.size()); i-- > 0;)
    if (frame.shows(curve.x[i], curve.y[i])) return i;
  return std::nullopt;
}

/// The plot with the names of lines at their ends, or all in a legend. Nothing where they have no room at their ends: when a line ends
/// before the right end of the axis, when many end at one place, or where a name is long.
std::optional<std::string> drawn(const CurvePlot& plot, SvgUse use, bool at_ends) {
  const PlotTicks ticks = ticks_of(plot);
  std::vector<PlotEntry> legend;
  std::vector<Named> ends;
  double room = 0.0;
  for (const Named& named : named_curves(plot)) {
    const bool points = named.curve->style == CurveStyle::kPoints;
    if (points || !at_ends) {
      legend.push_back({named.curve->name, named.color, points});
    } else if (named.curve->name != plot.y.label) {
      ends.push_back(named);
      room = std::max(room, 7.0 * static_cast<double>(named.curve->name.size()) + 8.0);
    }
  }
  if (legend.size() == 1 && ends.empty()) legend.clear();  // the axis says what it is
  constexpr double kWidest = 0.3;
  if (room > kWidest * plot.width) return std::nullopt;
  SvgFrame frame(plot.title, plot.width, plot.height, use, legend, room);
  frame.axes(plot.x, plot.y, ticks.along, ticks.upwards);
  std::vector<LineEnd> places;
  for (const Named& named : ends) {
    const auto end = end_of(*named.curve, frame);
    if (!end || frame.x(named.curve->x[*end]) < frame.x(ticks.along.high) - 6.0) return std::nullopt;
    places.push_back({named.curve->name, named.color, frame.y(named.curve->y[*end]), 0.0});
  }
  if (!frame.line_ends(std::move(places))) return std::nullopt;
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    const Curve& curve = plot.curves[c];
    if (curve.style == CurveStyle::kPoints)
      draw_points(frame, curve, color_of(plot, c));
    else
      draw_line(frame, curve, color_of(plot, c));
  }
  for (const CurveLimit& limit : plot.limits) frame.limit(limit);  // its words lie over the curves
  if (!ticks.any) frame.no_data();
  return frame.finish();
}

Status write_both(const std::filesystem::path& stem, const std::string& svg, const std::string& csv) {
  MORULA_TRY(write_file_atomically(stem.string() + ".csv", csv));
  return write_file_atomically(stem.string() + ".svg", svg);
}

}  // namespace

TimeAxis time_axis(double last) {
  if (last < 120.0) return {{"time", "s", false, {}, {}}, 1.0};
  if (last < 7200.0) return {{"time", "min", false, {}, {}}, 60.0};
  return {{"time", "h", false, {}, {}}, 3600.0};
}

std::string curves_svg(const CurvePlot& plot, SvgUse use) {
  if (auto with_ends = drawn(plot, use, true)) return *std::move(with_ends);
  return *drawn(plot, use, false);
}

std::string bars_svg(const BarPlot& plot, SvgUse use) {
  Range y;
  y.add(0.0, false);
  bool any = false;
  for (const BarSeries& series : plot.series)
    for (const double height : series.heights) y.add(height, false), any = true;
  std::vector<PlotEntry> legend;
  for (const BarSeries& series : plot.series) legend.push_back({series.name, static_cast<int>(legend.size())});
  if (legend.size() == 1) legend.clear();
  SvgFrame frame(plot.title, plot.width, plot.height, use, legend);
  const auto groups = static_cast<double>(std::max<std::size_t>(1, plot.categories.size()));
  Ticks along{0.0, groups, {}, {}};
  const std::size_t every = std::max<std::size_t>(1, (plot.categories.size() + 11) / 12);
  for (std::size_t i = 0; i < plot.categories.size(); i += every) {
    along.at.push_back(static_cast<double>(i) + 0.5);
    along.text.push_back(plot.categories[i]);
  }
  CurveAxis axis_x{plot.x.label, plot.x.unit, false, {}, {}}, axis_y{plot.y.label, plot.y.unit, false, {}, {}};
  frame.axes(axis_x, axis_y, along, ticks_of(axis_y, y, 5, true));
  const double share = 0.78 / static_cast<double>(std::max<std::size_t>(1, plot.series.size()));
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    for (std::size_t i = 0; i < std::min(plot.categories.size(), plot.series[s].heights.size()); ++i) {
      const double left = static_cast<double>(i) + 0.11 + share * static_cast<double>(s);
      if (std::isfinite(plot.series[s].heights[i])) frame.bar(left, left + share, plot.series[s].heights[i], static_cast<int>(s));
    }
  }
  if (!any) frame.no_data();
  return frame.finish();
}

BarPlot histogram(const std::vector<double>& values, int bins, const std::string& quantity, const std::string& unit) {
  BarPlot plot;
  plot.x = {quantity, unit, false, {}, {}};
  plot.y.label = "cells";
  Range range;
  for (const double value : values) range.add(value, false);
  if (range.empty()) return plot;
  const double span = range.high > range.low ? range.high - range.low : std::max(1e-9, std::abs(range.low));
  const double decade = nice_below(span / std::max(1, bins));
  const double step = span / decade > 2.0 * bins ? 2.0 * decade : decade;
  const double first = std::floor(range.low / step);
  const auto count = static_cast<std::size_t>(std::floor(range.high / step) - first) + 1;
  plot.series.push_back({"cells", std::vector<double>(count, 0.0)});
  for (std::size_t i = 0; i < count; ++i) plot.categories.push_back(short_number((first + static_cast<double>(i)) * step));
  for (const double value : values)
    if (std::isfinite(value))
      plot.series[0].heights[static_cast<std::size_t>(std::clamp(std::floor(value / step) - first, 0.0, static_cast<double>(count - 1)))] +=
          1.0;
  return plot;
}

Status write_curves(const CurvePlot& plot, const std::filesystem::path& stem) {
  return write_both(stem, curves_svg(plot), curves_csv(plot));
}
Status write_bars(const BarPlot& plot, const std::filesystem::path& stem) { return write_both(stem, bars_svg(plot), bars_csv(plot)); }

}  // namespace morula::scenarios
