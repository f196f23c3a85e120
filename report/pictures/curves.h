#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"

namespace morula::scenarios {

struct CurveAxis {
  std::string label;                ///< quantity
  std::string unit;                 ///< "" for a pure number
  bool logarithmic = false;         ///< base 10; values ≤ 0 are left out
  std::optional<double> low, high;  ///< where not given: from the data
};

/// The axis of times up to `last` [s] in seconds, minutes or hours, and how many seconds its unit has.
struct TimeAxis {
  CurveAxis axis;
  double unit = 1.0;
};
TimeAxis time_axis(double last);

enum class CurveStyle { kLine, kSteps, kPoints };

struct Curve {
  std::string name;
  std::vector<double> x, y;  ///< same length; a NaN interrupts the line
  CurveStyle style = CurveStyle::kLine;
  int color = -1;  ///< number in the palette; of curves that share one only the first is named; −1: its own
};

/// A horizontal dashed line that must not be crossed.
struct CurveLimit {
  double value = 0.0;
  std::string text;
};

/// Curves over one pair of axes.
struct CurvePlot {
  std::string title;
  CurveAxis x, y;
  std::vector<Curve> curves;
  std::vector<CurveLimit> limits;
  int width = 640, height = 360;
};

struct BarSeries {
  std::string name;
  std::vector<double> heights;  ///< one for each category
};

/// Groups of bars, one group for each category.
struct BarPlot {
  std::string title;
  CurveAxis x, y;  ///< x: label and unit only
  std::vector<std::string> categories;
  std::vector<BarSeries> series;
  int width = 640, height = 360;
};

/// How the SVG will be used: as a file (white background) or within a page (no background, ink in the page's text colour).
enum class SvgUse { kFile, kInline };

/// The plot as SVG text. Lines are named at their right ends where there is room, else in a legend; points in a legend. Without data: axes
/// and the words "no data". Deterministic.
std::string curves_svg(const CurvePlot& plot, SvgUse use = SvgUse::kFile);
std::string bars_svg(const BarPlot& plot, SvgUse use = SvgUse::kFile);

/// Counts of the values in `bins` equal, round intervals; NaN is left out. The categories are the lower ends of the intervals.
BarPlot histogram(const std::vector<double>& values, int bins, const std::string& quantity, const std::string& unit);

/// Write `<stem>.svg` and, beside it, `<stem>.csv` with the numbers that it shows (units in the header: `time [h]`).
Status write_curves(const CurvePlot& plot, const std::filesystem::path& stem);
Status write_bars(const BarPlot& plot, const std::filesystem::path& stem);

/// &, <, >, " and ' as XML entities; characters that XML forbids become U+FFFD.
std::string xml_escaped(std::string_view text);

}  // namespace morula::scenarios
