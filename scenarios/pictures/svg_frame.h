#pragma once
#include <string>
#include <utility>
#include <vector>

#include "scenarios/pictures/curves.h"
#include "scenarios/pictures/ticks.h"

namespace morula::scenarios {

/// The SVG text of one plot while it is drawn: axes first, then what they show.
class SvgFrame {
 public:
  /// `names` and `colors` of the legend, a row of its own below the title (more rows where the names are long); nothing for a single name.
  SvgFrame(const std::string& title, int width, int height, SvgUse use, const std::vector<std::string>& names = {},
           const std::vector<int>& colors = {});

  void axes(const CurveAxis& x, const CurveAxis& y, const Ticks& along, const Ticks& upwards);

  /// Data to SVG coordinates.
  [[nodiscard]] double x(double value) const;
  [[nodiscard]] double y(double value) const;
  /// Whether a point has a place (finite; positive on logarithmic axes), and whether that is within the axes.
  [[nodiscard]] bool defined(double x, double y) const;
  [[nodiscard]] bool shows(double x, double y) const;

  // In SVG coordinates; colours by number.
  void polyline(const std::vector<std::pair<double, double>>& points, int color);
  void point(double x, double y, int color);

  void bar(double left, double right, double height, int color);  ///< data coordinates
  void limit(const CurveLimit& limit);
  void no_data();
  std::string finish();

 private:
  void legend(const std::vector<std::string>& names, const std::vector<int>& colors);
  void text(double x, double y, const std::string& content, const char* anchor, double size, const std::string& more = "");

  std::string out_;
  int height_;
  double left_ = 70.0, right_, top_, bottom_;
  Ticks along_, upwards_;
  bool log_x_ = false, log_y_ = false;
};

}  // namespace morula::scenarios
