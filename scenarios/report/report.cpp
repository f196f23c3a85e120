#include "scenarios/report/report.h"

#include <algorithm>
#include <string_view>

#include "scenarios/pictures/annotate.h"
#include "scenarios/pictures/curves.h"
#include "scenarios/pictures/png.h"
#include "scenarios/report/report_style.h"
#include "scenarios/results/file_io.h"

namespace morula::scenarios {
namespace {

template <class... Parts>
void add(std::string& out, const Parts&... parts) {
  (out.append(parts), ...);
}

// Rows of escaped cells under a header; `marked` rows get a class.
struct Row {
  std::vector<std::string> cells;
  const char* mark = "";
};

void add_table(std::string& out, const std::vector<std::string>& header, const std::vector<Row>& rows) {
  add(out, "<table>\n");
  if (!header.empty()) {
    add(out, "<thead><tr>");
    for (const auto& cell : header) add(out, "<th>", xml_escaped(cell), "</th>");
    add(out, "</tr></thead>\n");
  }
  add(out, "<tbody>\n");
  for (const Row& row : rows) {
    add(out, row.mark[0] ? "<tr class=\"" : "<tr", row.mark, row.mark[0] ? "\">" : ">");
    for (const auto& cell : row.cells) add(out, "<td>", xml_escaped(cell), "</td>");
    add(out, "</tr>\n");
  }
  add(out, "</tbody></table>\n");
}

void add_head(std::string& out, const ReportContent& content) {
  const std::string title = xml_escaped(content.title.empty() ? content.study : content.title);
  add(out, "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n<meta charset=\"utf-8\"/>\n");
  add(out, "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>", title, "</title>\n<style>", kReportStyle,
      "</style>\n</head>\n<body>\n<main>\n<header>\n<h1>", title, "</h1>\n<p class=\"sub\">Study <code>", xml_escaped(content.study),
      "</code>");
  if (!content.scenario.empty()) add(out, " · scenario ", xml_escaped(content.scenario));
  add(out, "</p>\n");
  if (!content.state.empty() && content.state != "done")
    add(out, "<p class=\"warning\">This run is not complete: ", xml_escaped(content.state), ".</p>\n");
  if (!content.summary.empty()) add(out, "<p>", xml_escaped(content.summary), "</p>\n");
  add(out, "</header>\n");
}

void add_verdict(std::string& out, const ReportContent& content) {
  if (content.criteria.empty()) return;
  const auto passed = std::count_if(content.criteria.begin(), content.criteria.end(), [](const auto& c) { return c.passed; });
  const bool all = passed == static_cast<std::ptrdiff_t>(content.criteria.size());
  add(out, "<section>\n<h2>Verdict</h2>\n<p class=\"", all ? "badge good" : "badge bad", "\">", std::to_string(passed), " of ",
      std::to_string(content.criteria.size()), " criteria passed</p>\n");
  std::vector<Row> rows;
  for (const auto& c : content.criteria)
    rows.push_back({{c.id, c.text, c.value, c.limit, c.passed ? "✓ passed" : "✗ failed"}, c.passed ? "good" : "bad"});
  add_table(out, {"id", "criterion", "value", "limit", "result"}, rows);
  add(out, "</section>\n");
}

void add_key_numbers(std::string& out, const ReportContent& content) {
  if (content.key_numbers.empty()) return;
  add(out, "<section>\n<h2>Key numbers</h2>\n<dl class=\"numbers\">\n");
  for (const auto& n : content.key_numbers)
    add(out, "<div><dt>", xml_escaped(n.name), "</dt><dd>", xml_escaped(n.value), " <small>", xml_escaped(n.unit), "</small></dd></div>\n");
  add(out, "</dl>\n</section>\n");
}

Status add_pictures(std::string& out, const ReportContent& content, bool frames) {
  const auto wanted = [&](const Picture& picture) { return picture.frame == frames; };
  if (std::none_of(content.pictures.begin(), content.pictures.end(), wanted)) return {};
  add(out, frames ? "<section>\n<h2>Over time</h2>\n" : "<section>\n<h2>Final state</h2>\n", "<div class=\"", frames ? "frames" : "large",
      "\">\n");
  for (const Picture& picture : content.pictures) {
    if (!wanted(picture)) continue;
    MORULA_TRY_ASSIGN(const auto png, encode_png(picture.image));
    const std::string caption = xml_escaped(picture.caption);
    add(out, "<figure><img src=\"data:image/png;base64,", base64(png), "\" width=\"", std::to_string(picture.image.width), "\" height=\"",
        std::to_string(picture.image.height), "\" alt=\"", caption, "\"/><figcaption>", caption, "</figcaption></figure>\n");
  }
  add(out, "</div>\n</section>\n");
  return {};
}

void add_plots(std::string& out, const ReportContent& content) {
  if (content.plots.empty()) return;
  add(out, "<section>\n<h2>Curves</h2>\n<div class=\"plots\">\n");
  for (const ReportPlot& plot : content.plots)
    add(out, "<figure>", plot.svg, "<figcaption>", xml_escaped(plot.caption), "</figcaption></figure>\n");
  add(out, "</div>\n</section>\n");
}

void add_limits(std::string& out, const ReportContent& content) {
  if (content.limits.empty()) return;
  add(out, "<section>\n<h2>Limits</h2>\n");
  std::vector<Row> rows;
  for (const ReportLimit& limit : content.limits) {
    const bool kept = limit.worst <= limit.limit;  // a NaN is not kept
    rows.push_back({{limit.name, short_number(limit.worst) + " " + limit.unit, short_number(limit.limit) + " " + limit.unit,
                     limit.when < 0.0 ? "" : short_time(limit.when), kept ? "✓ kept" : "✗ crossed"},
                    kept ? "good" : "bad"});
  }
  add_table(out, {"quantity", "worst value", "limit", "at", "result"}, rows);
  add(out, "</section>\n");
}

void add_events(std::string& out, const ReportContent& content) {
  if (content.events.empty() && content.warnings.empty()) return;
  add(out, "<section>\n<h2>Events</h2>\n");
  std::vector<Row> rows;
  for (const ReportEvents& e : content.events)
    rows.push_back({{e.kind, std::to_string(e.count), e.count ? short_time(e.first) : "–", e.count ? short_time(e.last) : "–"}});
  if (!rows.empty()) add_table(out, {"event", "count", "first at", "last at"}, rows);
  constexpr std::size_t kShown = 50;
  rows.clear();
  for (const auto& [time, text] : content.warnings)
    if (rows.size() < kShown) rows.push_back({{short_time(time), text}});
  if (!rows.empty()) {
    add(out, "<h3>Warnings</h3>\n");
    add_table(out, {"time", "warning"}, rows);
    if (content.warnings.size() > kShown)
      add(out, "<p>and ", std::to_string(content.warnings.size() - kShown), " more in <code>events.jsonl</code></p>\n");
  }
  add(out, "</section>\n");
}

void add_methods(std::string& out, const ReportContent& content) {
  if (content.laws.empty()) return;
  add(out, "<section>\n<h2>Methods</h2>\n<p>Laws this run used. Lengths in µm, forces in nN, times in s, amounts in amol.</p>\n");
  for (const UsedLaw& use : content.laws) {
    add(out, "<article>\n<h3>", xml_escaped(use.law.title.empty() ? use.law.name : use.law.title), " <small>", xml_escaped(use.purpose),
        "</small></h3>\n");
    if (!use.law.equation.empty()) add(out, "<p class=\"equation\">", xml_escaped(use.law.equation), "</p>\n");
    if (!use.law.source.empty()) add(out, "<p class=\"source\">", xml_escaped(use.law.source), "</p>\n");
    std::vector<Row> rows;
    for (const LawParameter& p : use.law.parameters) rows.push_back({{p.name, used_value(use, p), p.unit, p.doc, p.source}});
    if (!rows.empty()) add_table(out, {"parameter", "value", "unit", "meaning", "source of the default"}, rows);
    add(out, "</article>\n");
  }
  add(out, "</section>\n");
}

void add_provenance(std::string& out, const ReportContent& content) {
  if (content.provenance.empty()) return;
  add(out, "<section>\n<h2>How it was run</h2>\n");
  std::vector<Row> rows;
  for (const auto& [key, value] : content.provenance) rows.push_back({{key, value}});
  add_table(out, {}, rows);
  add(out, "</section>\n");
}

}  // namespace

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t have = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = static_cast<std::uint32_t>(bytes[i]) << 16;
    if (have > 1) group |= static_cast<std::uint32_t>(bytes[i + 1]) << 8;
    if (have > 2) group |= bytes[i + 2];
    for (std::size_t d = 0; d < 4; ++d) out += d <= have ? kDigits[(group >> (18 - 6 * d)) & 63] : '=';
  }
  return out;
}

Result<std::string> report_html(const ReportContent& content) {
  std::string out;
  add_head(out, content);
  add_verdict(out, content);
  add_key_numbers(out, content);
  MORULA_TRY(add_pictures(out, content, true));
  MORULA_TRY(add_pictures(out, content, false));
  add_plots(out, content);
  add_limits(out, content);
  add_events(out, content);
  add_provenance(out, content);
  add_methods(out, content);
  add(out, "</main>\n</body>\n</html>\n");
  return out;
}

Status write_report(const ReportContent& content, const std::filesystem::path& path) {
  MORULA_TRY_ASSIGN(const std::string html, report_html(content));
  return write_file_atomically(path, html);
}

}  // namespace morula::scenarios
