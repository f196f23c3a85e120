#pragma once
#include <string>
#include <utility>
#include <vector>

#include "report/pictures/curves.h"
#include "report/pictures/line_ends.h"
#include "report/pictures/ticks.h"

namespace morula::scenarios {

/// An entry of a plot's legend: a short line or a point of this colour.
struct PlotEntry {
  std::string name;
  int color = 0;
  bool points = false;
};

/// The SVG text of one plot while it is drawn: axes first, then what they show.
class SvgFrame {
 public:
  /// Long titles take several lines. The legend has rows of its own below them. `room_for_ends`: at the right, for names of lines [px].
  SvgFrame(const std::string& title, int width, int height, SvgUse use, std::vector<PlotEntry> legend, double room_for_ends = 0.0);

  void axes(const CurveAxis& x, const CurveAxis& y, const Ticks& along, const Ticks& upwards);

  /// Data to SVG coordinates.
  [[nodiscard]] double x(double value) const;
  [[nodiscard]] double y(double value) const;
  /// Whether a point has a place (finite; positive on logarithmic axes), and whether that is within the axes.
  [[nodiscard]] bool defined(double x, double y) const;
  [[nodiscard]] bool shows(double x, double y) const;

  // In SVG coordinates; colours by number.
  void polyline(const std::vector<std::pair<double, double>>& points, int color);  ///< the part between the ends of the axis along x
  void point(double x, double y, int color);

  void bar(double left, double right, double height, int color);  ///< data coordinates
  void limit(const CurveLimit& limit);
  /// Names at the right ends of lines. False, and nothing is written, where they have no room.
  bool line_ends(std::vector<LineEnd> ends);
  void no_data();
  std::string finish();

 private:
  void legend();
  void line(const std::vector<std::pair<double, double>>& points, int color);
  void text(double x, double y, const std::string& content, const char* anchor, double size, const std::string& more = "");

  std::string out_;
  std::vector<PlotEntry> legend_;
  int height_;
  double left_ = 70.0, right_, top_, bottom_;
  Ticks along_, upwards_;
  bool log_x_ = false, log_y_ = false;
};

}  // namespace morula::scenarios
