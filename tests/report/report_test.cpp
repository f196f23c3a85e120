#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <regex>
#include <sstream>

#include "report/pictures/curves.h"
#include "report/report.h"
#include "results/series_reader.h"
#include "tests/report/report_support.h"

namespace morula::scenarios {
namespace {

using test::kNasty, test::some_plot, test::xml_fault;

ReportContent full_content() {
  ReportContent content;
  content.title = content.study = content.scenario = content.summary = content.state = kNasty;
  content.criteria = {{kNasty, kNasty, kNasty, kNasty, true}, {"S1.2", "a criterion", "3 µm", "≤ 2 µm", false}};
  content.key_numbers = {{kNasty, kNasty, kNasty}};
  content.pictures = {encoded({"a", kNasty, 0.0, true, Image(3, 2, {0.5f, 0.5f, 0.5f})}).value(),
                      encoded({"b", kNasty, 60.0, false, Image(3, 2, {})}).value()};
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

TEST(Report, IsWellFormedSelfContainedAndEscaped) {
  const auto html = report_html(full_content());
  EXPECT_EQ(xml_fault(html), "");
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("src=\"http"), std::string::npos);
  EXPECT_EQ(html.find("href="), std::string::npos);
  EXPECT_NE(html.find("1 of 2 criteria passed"), std::string::npos);
  EXPECT_NE(html.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);  // the PNG signature
  EXPECT_EQ(html, report_html(full_content()));
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(Report, FramesOfARowHaveOneSliderAndShowTheLast) {
  ReportContent content;
  for (const char* name : {"cells_00", "cells_01", "cells_02", "cut_pressure_00", "cut_pressure_01", "alone_00"})
    content.pictures.push_back(encoded({name, name, 60.0 * static_cast<double>(content.pictures.size()), true, Image(3, 2, {})}).value());
  const auto html = report_html(content);
  EXPECT_EQ(xml_fault(html), "");
  EXPECT_EQ(count_of(html, "class=\"film\""), 3u);
  EXPECT_EQ(count_of(html, "type=\"range\" min=\"0\" max=\"2\" value=\"2\""), 1u);
  EXPECT_EQ(count_of(html, "type=\"range\" min=\"0\" max=\"1\" value=\"1\""), 1u);
  EXPECT_EQ(count_of(html, "type=\"range\""), 2u) << "a single frame needs none";
  EXPECT_EQ(count_of(html, "<figure hidden=\"hidden\">"), 3u);
  EXPECT_EQ(count_of(html, "<figure><img"), 3u);
}

TEST(Report, SolverPlotsLieBelowAFold) {
  ReportContent content;
  content.plots = {{"size of the tissue", "<svg id=\"a\"></svg>", false}, {"step size", "<svg id=\"b\"></svg>", true}};
  const auto html = report_html(content);
  EXPECT_EQ(xml_fault(html), "");
  const std::size_t fold = html.find("<details>"), first = html.find("id=\"a\""), second = html.find("id=\"b\"");
  EXPECT_LT(first, fold);
  EXPECT_LT(fold, second);
  EXPECT_LT(second, html.find("</details>"));
}

TEST(Report, ChecksOfAUsersStudySayWhatTheyDoNotTell) {
  ReportContent content;
  content.criteria = {{"INV.4", "overlap", "0.1 um", "<= 0.3 um", true}};
  content.not_checked = {{"", "the parameters", "nobody has measured them"}};
  std::string html = report_html(content);
  EXPECT_NE(html.find("<h2>Numerical checks</h2>"), std::string::npos);
  EXPECT_EQ(html.find("<h2>Verdict</h2>"), std::string::npos);
  EXPECT_NE(html.find("1 of 1 checks passed"), std::string::npos);
  EXPECT_NE(html.find("<h2>Not checked</h2>"), std::string::npos);
  EXPECT_NE(html.find("the parameters"), std::string::npos);
  EXPECT_NE(html.find("&lt;= 0.3 µm"), std::string::npos);
  content.criteria.push_back({"S6.1", "angle", "60 deg", "58 to 62 deg", true});
  html = report_html(content);
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
  EXPECT_EQ(xml_fault(html), "");
  for (const char* part : {"study: &lt;mine&gt;", "radius: 6 um", "Morula 0.1.0", "@software{morula,"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

TEST(Report, LimitThatIsCrossedOrNotANumberIsNotKept) {
  const auto html = report_html(full_content());
  std::size_t crossed = 0;
  for (std::size_t at = html.find("✗ crossed"); at != std::string::npos; at = html.find("✗ crossed", at + 1)) ++crossed;
  EXPECT_EQ(crossed, 2u);
}

TEST(Report, EmptyRunGivesAPageToo) {
  const auto html = report_html({});
  EXPECT_EQ(xml_fault(html), "");
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
