// Curves and the plots that every run gets.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "report/pictures/curves.h"
#include "report/pictures/line_ends.h"
#include "report/run_plots.h"
#include "results/series_reader.h"
#include "tests/report/report_support.h"

namespace morula::scenarios {
namespace {

using test::some_plot, test::xml_fault;

TEST(Curves, SvgIsWellFormedAndEscaped) {
  for (const SvgUse use : {SvgUse::kFile, SvgUse::kInline}) {
    const std::string svg = curves_svg(some_plot(), use);
    EXPECT_EQ(xml_fault(svg), "") << svg;
    EXPECT_EQ(svg.find("<script"), std::string::npos);
    EXPECT_EQ(svg.find('\x01'), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg, curves_svg(some_plot(), use));
  }
}

TEST(Curves, NanInterruptsTheLine) {
  CurvePlot plot = some_plot();
  plot.curves.resize(1);
  const std::string svg = curves_svg(plot);
  std::size_t lines = 0;
  for (std::size_t at = svg.find("<polyline"); at != std::string::npos; at = svg.find("<polyline", at + 1)) ++lines;
  EXPECT_EQ(lines, 2u);
}

TEST(Curves, PointsLieWhereTheirAxesSay) {
  CurvePlot plot;
  plot.x = {"x", "", false, 0.0, 10.0};
  plot.y = {"y", "", true, 1.0, 100.0};
  plot.curves = {{"only", {5.0}, {10.0}, CurveStyle::kPoints}};
  // axes: 70 .. 622 across, 18 .. 310 down; the middle of both, on a logarithmic axis too
  EXPECT_NE(curves_svg(plot).find("<circle cx=\"346\" cy=\"164\""), std::string::npos) << curves_svg(plot);
}

TEST(Curves, WithoutDataThePlotSaysSo) {
  CurvePlot plot;
  plot.y.logarithmic = true;
  EXPECT_EQ(xml_fault(curves_svg(plot)), "");
  EXPECT_NE(curves_svg(plot).find("no data"), std::string::npos);
  EXPECT_EQ(xml_fault(bars_svg({})), "");
}

TEST(Curves, HistogramCountsEveryValueOnceInRoundIntervals) {
  std::vector<double> values;
  for (int i = 0; i < 100; ++i) values.push_back(0.13 * i);
  values.push_back(std::nan(""));
  const BarPlot plot = histogram(values, 10, "volume", "µm³");
  double sum = 0.0;
  for (const double height : plot.series.at(0).heights) sum += height;
  EXPECT_EQ(sum, 100.0);
  EXPECT_EQ(plot.categories.at(1), "1");
  EXPECT_EQ(plot.series[0].heights[0], 8.0);  // 0, 0.13 … 0.91
  EXPECT_EQ(xml_fault(bars_svg(plot)), "");
}

TEST(Curves, FileStandsBesideItsNumbers) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "morula_curves";
  std::filesystem::create_directories(folder);
  ASSERT_TRUE(write_curves(some_plot(), folder / "pressure").ok());
  EXPECT_TRUE(std::filesystem::exists(folder / "pressure.svg"));
  std::ifstream csv(folder / "pressure.csv");
  std::string header, row;
  std::getline(csv, header);
  std::getline(csv, row);
  EXPECT_EQ(header.substr(0, 15), "curve,time [h],");
  EXPECT_EQ(row, "mean,0,0.1");
  std::filesystem::remove_all(folder);
}

TEST(Curves, LegendHasItsOwnRowsBelowTheTitle) {
  CurvePlot plot;
  plot.title = "A title that is long enough to reach far into the right half of the plot";
  for (const char* name : {"the first of some long names", "the second of some long names", "the third of some long names", "fourth"})
    plot.curves.push_back({name, {0.0, 1.0}, {0.0, 1.0}});
  const std::string svg = curves_svg(plot);
  EXPECT_EQ(xml_fault(svg), "");
  EXPECT_NE(svg.find("height=\"396\""), std::string::npos) << "two rows of 18 more than 360";
  for (const char* row : {"y=\"42\"", "y=\"60\""}) EXPECT_NE(svg.find(row), std::string::npos) << row;
}

TEST(Curves, NumbersAlongTheAxisDoNotTouchAndUnitsHaveTheirSigns) {
  CurvePlot plot;
  plot.x = {"volume", "um^3", false, 0.0, 0.0012};
  plot.width = 260;  // too narrow for all numbers
  plot.curves = {{"only", {0.0, 0.0012}, {0.0, 1.0}}};
  const std::string svg = curves_svg(plot);
  EXPECT_NE(svg.find("volume [µm³]"), std::string::npos);
  // numbers along x: middle-anchored texts of size 12, 7 pixels a character
  static const std::regex kNumber("<text x=\"([0-9.]+)\" y=\"[0-9.]+\" text-anchor=\"middle\" font-size=\"12\"[^>]*>([^<]*)<");
  double free_from = -1e300;
  int numbers = 0;
  for (std::sregex_iterator it(svg.begin(), svg.end(), kNumber), end; it != end; ++it, ++numbers) {
    const double at = std::stod((*it)[1]), half = 3.5 * static_cast<double>((*it)[2].length());
    EXPECT_GT(at - half, free_from);
    free_from = at + half;
  }
  EXPECT_GE(numbers, 2);
}

TEST(Curves, LinesAreNamedAtTheirEndsAndPointsInALegend) {
  CurvePlot plot;
  plot.title = "A plot";
  plot.y.label = "force";
  plot.curves = {{"upper", {0.0, 1.0}, {0.0, 3.0}}, {"lower", {0.0, 1.0}, {0.0, 1.0}}, {"measured", {0.5}, {0.5}, CurveStyle::kPoints}};
  const std::string svg = curves_svg(plot);
  EXPECT_EQ(xml_fault(svg), "");
  // Right of the axis: 622 less the room for five letters.
  const auto places = [](const std::string& text) {
    static const std::regex kName("<text x=\"([0-9.]+)\" y=\"([0-9.]+)\" text-anchor=\"start\" font-size=\"12\"[^>]*>([^<]*)<");
    std::map<std::string, std::pair<double, double>> out;
    for (std::sregex_iterator it(text.begin(), text.end(), kName), end; it != end; ++it)
      out[(*it)[3]] = {std::stod((*it)[1]), std::stod((*it)[2])};
    return out;
  };
  auto names = places(svg);
  ASSERT_EQ(names.size(), 3u);
  EXPECT_GT(names["upper"].first, 570.0);
  EXPECT_GT(names["lower"].first, 570.0);
  EXPECT_LT(names["upper"].second, names["lower"].second - 50.0);
  EXPECT_LT(names["measured"].second, 60.0) << "in the legend, above the axes";
  // A line that ends early has no end at the axis: all are in the legend.
  plot.curves[0].x = {0.0, 0.5};
  names = places(curves_svg(plot));
  ASSERT_EQ(names.size(), 3u);
  for (const auto& [name, place] : names) EXPECT_LT(place.second, 60.0) << name;
  // A single curve that is called as its axis says nothing new.
  plot.curves = {{"force", {0.0, 1.0}, {0.0, 3.0}}};
  EXPECT_TRUE(places(curves_svg(plot)).empty());
}

TEST(Curves, NamesAtLineEndsKeepApartOrAreLeftToTheLegend) {
  std::vector<LineEnd> ends;
  for (const double y : {100.0, 104.0, 20.0, 99.0, 300.0}) ends.push_back({std::to_string(y), 0, y, 0.0});
  ASSERT_TRUE(place_line_ends(ends, 10.0, 305.0, 14.0, 24.0));
  for (std::size_t i = 1; i < ends.size(); ++i) {
    EXPECT_GE(ends[i].y, ends[i - 1].y) << "in the order of the lines";
    EXPECT_GE(ends[i].at - ends[i - 1].at, 14.0 - 1e-9);
  }
  EXPECT_EQ(ends[0].at, 20.0) << "what has room stays";
  EXPECT_NEAR(ends[1].at + ends[2].at + ends[3].at, 99.0 + 100.0 + 104.0, 1e-9) << "three around their mean";
  std::vector<LineEnd> crowd(6, LineEnd{"a", 0, 100.0, 0.0});
  EXPECT_FALSE(place_line_ends(crowd, 10.0, 305.0, 14.0, 24.0)) << "the first would stand 35 from its line";
  std::vector<LineEnd> many(30, LineEnd{"a", 0, 100.0, 0.0});
  EXPECT_FALSE(place_line_ends(many, 10.0, 305.0, 14.0, 1e9)) << "no room at all";
}

TEST(Curves, LongTitlesAreBrokenAndFilesAreWhiteInAnyReader) {
  CurvePlot plot;
  plot.title = "Shear: force on the grip (dashes of points: friction times contact area times speed), with more words at its end";
  plot.curves = {{"only", {0.0, 1.0}, {0.0, 1.0}}};
  const std::string svg = curves_svg(plot);
  EXPECT_EQ(svg.find(plot.title + "</text>"), std::string::npos);
  EXPECT_NE(svg.find("<text x=\"16\" y=\"41\""), std::string::npos) << "a second line";
  EXPECT_NE(svg.find("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>"), std::string::npos);
  EXPECT_EQ(curves_svg(plot, SvgUse::kInline).find("<rect"), std::string::npos) << "a page has its own";
}

TEST(Curves, LinesEndAtTheAxisAndPointsLieWithinIt) {
  CurvePlot plot;
  plot.x = {"time", "s", false, 0.0, 1.0};
  plot.curves = {{"only", {-1.0, 3.0}, {0.0, 4.0}}};  // passes 1 at 0 and 2 at 1
  const std::string svg = curves_svg(plot);
  const std::size_t at = svg.find("points=\"") + 8;
  std::istringstream numbers(svg.substr(at, svg.find('"', at) - at));
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  char comma = 0;
  ASSERT_TRUE(numbers >> x0 >> comma >> y0 >> x1 >> comma >> y1);
  EXPECT_NEAR(x0, 70.0, 0.01);
  EXPECT_LE(x1, 622.0);
  EXPECT_NEAR(y0 - y1, (310.0 - 18.0) / 4.0, 0.1) << "a quarter of the range of the axis, 0 to 4";
  plot.x = {"speed", "", false, {}, {}};
  plot.curves = {{"a", {0.05, 0.1}, {1.0, 2.0}, CurveStyle::kPoints}};
  const std::string points = curves_svg(plot);
  static const std::regex kPoint("<circle cx=\"([0-9.]+)\"");
  for (std::sregex_iterator it(points.begin(), points.end(), kPoint), end; it != end; ++it) {
    EXPECT_GT(std::stod((*it)[1]), 75.0);
    EXPECT_LT(std::stod((*it)[1]), 617.0);
  }
}

TEST(StandardPlots, TellTimeInItsUnitAndLeaveOutStepsBeforeTheFirst) {
  const auto series =
      parse_series("time [s],step_size [s],spheroid_radius [um],cell_count [1]\n0,0.1,50,2\n10,2,50.1,2\n20,3,50.2,3\n", "test");
  ASSERT_TRUE(series.ok());
  std::map<std::string, NamedPlot> plots;
  for (NamedPlot& plot : standard_plots(Study{}, *series)) plots.emplace(plot.name, plot);
  EXPECT_EQ(plots.at("step").plot.x.unit, "s");
  EXPECT_EQ(plots.at("step").plot.curves.at(0).x, (std::vector<double>{10.0, 20.0}));
  EXPECT_EQ(plots.count("size"), 0u) << "0.4 % is no growth";
  EXPECT_EQ(plots.at("cells_by_body").plot.title, "Cells") << "there is but one kind of body";
}

TEST(StandardPlots, ShowWhatCavitiesDo) {
  Study study;
  study.model.lumens.resize(1);
  study.model.lumens[0].name = "lumen";
  const auto series =
      parse_series("time [s],volume_lumen [um^3],pressure_lumen [kPa],open_lumen [1]\n0,0,0,0.1\n60,500,0.02,0.1\n", "test");
  ASSERT_TRUE(series.ok());
  std::map<std::string, NamedPlot> plots;
  for (NamedPlot& plot : standard_plots(study, *series)) plots.emplace(plot.name, plot);
  EXPECT_EQ(plots.at("lumen_volume").plot.curves.at(0).y, (std::vector<double>{0.0, 500.0}));
  EXPECT_EQ(plots.at("lumen_pressure").plot.curves.at(0).y, (std::vector<double>{0.0, 20.0})) << "in Pa";
  EXPECT_EQ(plots.count("lumen_open"), 0u) << "it does not change";
}

TEST(StandardPlots, ShowNothingWhereNothingHappens) {
  Study study;
  study.model.types.resize(2);
  study.model.types[0].name = "a";
  study.model.types[1].name = "b";
  const auto series = parse_series(
      "time [s],cell_count [1],sphere_count [1],shell_count [1],count_a [1],count_b [1],divisions [1],deaths [1],spheroid_radius [um],"
      "step_size [s],volume_error [1]\n"
      "0,2,2,0,2,0,0,0,5,1,0\n86400,4,4,0,4,0,2,0,5,1,0\n",
      "test");
  ASSERT_TRUE(series.ok());
  std::map<std::string, NamedPlot> plots;
  for (NamedPlot& plot : standard_plots(study, *series)) plots.emplace(plot.name, plot);
  ASSERT_EQ(plots.count("cells_by_body"), 1u);
  EXPECT_EQ(plots.at("cells_by_body").plot.curves.size(), 1u) << "spheres are all cells, and there is no shell";
  EXPECT_EQ(plots.at("cells_by_body").plot.curves[0].style, CurveStyle::kSteps);
  ASSERT_EQ(plots.at("events").plot.curves.size(), 1u);
  EXPECT_EQ(plots.at("events").plot.curves[0].name, "divisions");
  EXPECT_EQ(plots.count("size"), 0u) << "it does not change";
  ASSERT_EQ(plots.count("step"), 1u);
  EXPECT_TRUE(plots.at("step").numerics);
  EXPECT_TRUE(plots.at("volume_error").numerics) << "against its limit, also at zero";
  EXPECT_FALSE(plots.at("events").numerics);
}

}  // namespace
}  // namespace morula::scenarios
