#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <regex>
#include <sstream>

#include "scenarios/pictures/curves.h"
#include "scenarios/report/report.h"
#include "scenarios/report/series_reader.h"
#include "scenarios/run/run_plots.h"

namespace morula::scenarios {
namespace {

// Checks that text is well-formed XML: one root, tags nest, attributes quoted, no stray < or &. Empty when it is, else what is wrong.
std::string xml_fault(std::string_view text) {
  std::vector<std::string> open;
  std::size_t roots = 0;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '&') {
      const std::size_t end = text.find(';', i);
      if (end == std::string_view::npos || end - i > 8) return "stray & at " + std::to_string(i);
      i = end + 1;
    } else if (text[i] == '>') {
      // CSS uses it as a combinator; XML allows it in text
      ++i;
    } else if (text[i] != '<') {
      ++i;
    } else if (text.substr(i, 2) == "<!" || text.substr(i, 2) == "<?") {
      i = text.find('>', i) + 1;
    } else {
      std::size_t end = i + 1;
      char quote = 0;
      for (; end < text.size() && (quote || text[end] != '>'); ++end) {
        if (quote && text[end] == '<') return "< in an attribute at " + std::to_string(end);
        if (quote)
          quote = text[end] == quote ? 0 : quote;
        else if (text[end] == '"' || text[end] == '\'')
          quote = text[end];
        else if (text[end] == '<')
          return "< within a tag at " + std::to_string(end);
      }
      if (end == text.size()) return "tag without end at " + std::to_string(i);
      const std::string_view tag = text.substr(i + 1, end - i - 1);
      const std::string name(tag.substr(tag.front() == '/' ? 1 : 0, tag.find_first_of(" /\n", 1) - (tag.front() == '/' ? 1 : 0)));
      if (name.empty()) return "tag without a name at " + std::to_string(i);
      if (tag.front() == '/') {
        if (open.empty() || open.back() != name) return "</" + name + "> does not close what is open";
        open.pop_back();
      } else if (tag.back() != '/') {
        if (open.empty()) ++roots;
        open.push_back(name);
      }
      i = end + 1;
    }
  }
  if (!open.empty()) return "<" + open.back() + "> is never closed";
  return roots == 1 ? "" : std::to_string(roots) + " roots";
}

constexpr const char* kNasty = "<script>alert('x')</script> & \"quotes\" \x01";

CurvePlot some_plot() {
  CurvePlot plot;
  plot.title = kNasty;
  plot.x = {"time", "h", false, {}, {}};
  plot.y = {kNasty, "kPa", false, {}, {}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  plot.curves = {{"mean", {0, 1, 2, 3, 4}, {0.1, 0.2, nan, 0.4, 0.3}, CurveStyle::kLine},
                 {kNasty, {0, 1, 2}, {0.2, 0.1, 0.3}, CurveStyle::kPoints},
                 {"steps", {0, 2, 4}, {0.0, 0.1, 0.2}, CurveStyle::kSteps}};
  plot.limits = {{0.5, "limit <0.5"}};
  return plot;
}

ReportContent full_content() {
  ReportContent content;
  content.title = content.study = content.scenario = content.summary = content.state = kNasty;
  content.criteria = {{kNasty, kNasty, kNasty, kNasty, true}, {"S1.2", "a criterion", "3 µm", "≤ 2 µm", false}};
  content.key_numbers = {{kNasty, kNasty, kNasty}};
  content.pictures = {{"a", kNasty, 0.0, true, Image(3, 2, {0.5f, 0.5f, 0.5f})}, {"b", kNasty, 60.0, false, Image(3, 2, {})}};
  content.plots = {{kNasty, curves_svg(some_plot(), SvgUse::kInline)}};
  content.limits = {{kNasty, 0.01, 0.02, "1", 60.0}, {"overlap", 0.4, 0.3, "µm", -1.0}, {"balance", std::nan(""), 1.0, "1", -1.0}};
  content.events = {{kNasty, 3, 10.0, 100.0}};
  content.warnings = {{5.0, kNasty}};
  content.provenance = {{"command", kNasty}, {"host", kNasty}};
  content.laws = {
      {kNasty, {kNasty, kNasty, kNasty, kNasty, {{kNasty, "pressure", "kPa", 1.0, 0.0, 2.0, kNasty, kNasty}}}, {{kNasty, 0.25}}}};
  return content;
}

TEST(XmlCheck, FindsWhatIsWrong) {
  EXPECT_EQ(xml_fault("<a b=\"1\"><c/>x &amp; y</a>"), "");
  EXPECT_NE(xml_fault("<a><b></a></b>"), "");
  EXPECT_NE(xml_fault("<a>1 & 2</a>"), "");
  EXPECT_NE(xml_fault("<a>"), "");
  EXPECT_NE(xml_fault("<a/ <b/>"), "");
}

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

TEST(Report, IsWellFormedSelfContainedAndEscaped) {
  const auto html = report_html(full_content());
  ASSERT_TRUE(html.ok());
  EXPECT_EQ(xml_fault(*html), "");
  EXPECT_EQ(html->find("<script"), std::string::npos);
  EXPECT_EQ(html->find("src=\"http"), std::string::npos);
  EXPECT_EQ(html->find("href="), std::string::npos);
  EXPECT_NE(html->find("1 of 2 criteria passed"), std::string::npos);
  EXPECT_NE(html->find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);  // the PNG signature
  EXPECT_EQ(*html, *report_html(full_content()));
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(Report, FramesOfARowHaveOneSliderAndShowTheLast) {
  ReportContent content;
  for (const char* name : {"cells_00", "cells_01", "cells_02", "cut_pressure_00", "cut_pressure_01", "alone_00"})
    content.pictures.push_back({name, name, 60.0 * static_cast<double>(content.pictures.size()), true, Image(3, 2, {})});
  const auto html = report_html(content);
  ASSERT_TRUE(html.ok());
  EXPECT_EQ(xml_fault(*html), "");
  EXPECT_EQ(count_of(*html, "class=\"film\""), 3u);
  EXPECT_EQ(count_of(*html, "type=\"range\" min=\"0\" max=\"2\" value=\"2\""), 1u);
  EXPECT_EQ(count_of(*html, "type=\"range\" min=\"0\" max=\"1\" value=\"1\""), 1u);
  EXPECT_EQ(count_of(*html, "type=\"range\""), 2u) << "a single frame needs none";
  EXPECT_EQ(count_of(*html, "<figure hidden=\"hidden\">"), 3u);
  EXPECT_EQ(count_of(*html, "<figure><img"), 3u);
}

TEST(Report, SolverPlotsLieBelowAFold) {
  ReportContent content;
  content.plots = {{"size of the tissue", "<svg id=\"a\"></svg>", false}, {"step size", "<svg id=\"b\"></svg>", true}};
  const auto html = report_html(content);
  ASSERT_TRUE(html.ok());
  EXPECT_EQ(xml_fault(*html), "");
  const std::size_t fold = html->find("<details>"), first = html->find("id=\"a\""), second = html->find("id=\"b\"");
  EXPECT_LT(first, fold);
  EXPECT_LT(fold, second);
  EXPECT_LT(second, html->find("</details>"));
}

TEST(Report, ChecksOfAUsersStudySayWhatTheyDoNotTell) {
  ReportContent content;
  content.criteria = {{"INV.4", "overlap", "0.1 um", "<= 0.3 um", true}};
  content.not_checked = {{"", "the parameters", "nobody has measured them"}};
  std::string html = *report_html(content);
  EXPECT_NE(html.find("<h2>Numerical checks</h2>"), std::string::npos);
  EXPECT_EQ(html.find("<h2>Verdict</h2>"), std::string::npos);
  EXPECT_NE(html.find("1 of 1 checks passed"), std::string::npos);
  EXPECT_NE(html.find("<h2>Not checked</h2>"), std::string::npos);
  EXPECT_NE(html.find("the parameters"), std::string::npos);
  EXPECT_NE(html.find("&lt;= 0.3 µm"), std::string::npos);
  content.criteria.push_back({"S6.1", "angle", "60 deg", "58 to 62 deg", true});
  html = *report_html(content);
  EXPECT_NE(html.find("<h2>Verdict</h2>"), std::string::npos);
  EXPECT_NE(html.find("2 of 2 criteria passed"), std::string::npos);
}

TEST(Report, HoldsTheStudyAndHowToCite) {
  ReportContent content;
  content.study_text = "study: <mine>";
  content.parameters_text = "radius: 6 um";
  content.citation = "Morula 0.1.0";
  content.bibtex = "@software{morula,\n}";
  const auto html = report_html(content);
  ASSERT_TRUE(html.ok());
  EXPECT_EQ(xml_fault(*html), "");
  for (const char* part : {"study: &lt;mine&gt;", "radius: 6 um", "Morula 0.1.0", "@software{morula,"})
    EXPECT_NE(html->find(part), std::string::npos) << part;
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

TEST(Report, LimitThatIsCrossedOrNotANumberIsNotKept) {
  const auto html = report_html(full_content());
  ASSERT_TRUE(html.ok());
  std::size_t crossed = 0;
  for (std::size_t at = html->find("✗ crossed"); at != std::string::npos; at = html->find("✗ crossed", at + 1)) ++crossed;
  EXPECT_EQ(crossed, 2u);
}

TEST(Report, EmptyRunGivesAPageToo) {
  const auto html = report_html({});
  ASSERT_TRUE(html.ok());
  EXPECT_EQ(xml_fault(*html), "");
}

TEST(Report, FailsWithAFileErrorWhereItCannotWrite) {
  const Status status = write_report({}, "/nonexistent-folder/report.html");
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kFile);
}

TEST(Report, Base64MatchesTheVectorsOfRfc4648) {
  const auto of = [](std::string_view text) { return base64(std::vector<std::uint8_t>(text.begin(), text.end())); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

TEST(Methods, NameEveryLawWithEquationSourceAndTheValueUsed) {
  UsedLaw use{"contact of spheres", {"jkr", "JKR contact", "F = 4/3 E* …", "Johnson 1971", {}}, {{"work_of_adhesion", 0.1}}};
  use.law.parameters = {{"work_of_adhesion", "surface energy", "nN/µm", 0.2, 0.0, 1.0, "a source", "energy | area"},
                        {"young", "pressure", "kPa", 0.45, 0.0, 9.0, "b source", "stiffness"},
                        {"radius", "length", "µm", {}, 0.0, 9.0, "", "no fallback"}};
  const std::string text = methods_text("a study", std::span(&use, 1), "seed: 1  # default: chosen\n");
  EXPECT_NE(text.find("F = 4/3 E* …"), std::string::npos);
  EXPECT_NE(text.find("Johnson 1971"), std::string::npos);
  EXPECT_NE(text.find("| work_of_adhesion | 0.1 | nN/µm | energy \\| area |\n"), std::string::npos) << text;
  EXPECT_NE(text.find("| young | not set | kPa |"), std::string::npos);  // not the law's own default, which the model need not have
  EXPECT_NE(text.find("| radius | not set |"), std::string::npos);
  EXPECT_NE(text.find("```yaml\nseed: 1  # default: chosen\n```\n"), std::string::npos);
}

TEST(SeriesReader, ReadsNamesUnitsAndValues) {
  const auto table = parse_series("time [h],pressure [kPa], cells \r\n0,1.5,10\n0.5,,11\n1,-2e-3,+12\n2,3", "series.csv");
  ASSERT_TRUE(table.ok()) << table.error().message;
  ASSERT_EQ(table->columns.size(), 3u);
  EXPECT_EQ(table->rows(), 3u);  // the last line is still being written
  EXPECT_EQ(table->columns[1].name, "pressure");
  EXPECT_EQ(table->columns[1].unit, "kPa");
  EXPECT_EQ(table->find("cells")->unit, "");
  EXPECT_EQ(table->find("cells")->values.back(), 12.0);
  EXPECT_TRUE(std::isnan(table->find("pressure")->values[1]));
  EXPECT_EQ(table->find("pressure")->values[2], -2e-3);
  EXPECT_EQ(table->find("nothing"), nullptr);
}

TEST(SeriesReader, NamesTheLineThatIsWrong) {
  const auto fault = [](const char* text) {
    const auto table = parse_series(text, "series.csv");
    return table.ok() ? std::string() : table.error().message;
  };
  EXPECT_EQ(fault("a,b\n1,2\n3\n").substr(0, 13), "series.csv:3:");
  EXPECT_EQ(fault("a,b\n1,2,3\n").substr(0, 13), "series.csv:2:");
  EXPECT_NE(fault("a,b\n1,x2\n").find("x2"), std::string::npos);
  EXPECT_NE(fault("a,a [h]\n").find("two columns"), std::string::npos);
  EXPECT_NE(fault("a,,b\n").find("no name"), std::string::npos);
  EXPECT_NE(fault("").find("empty"), std::string::npos);
  EXPECT_EQ(read_series("/nonexistent/series.csv").error().kind, ErrorKind::kFile);
}

}  // namespace
}  // namespace morula::scenarios
