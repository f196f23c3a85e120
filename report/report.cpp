#include "report/report.h"

#include <algorithm>
#include <span>
#include <string_view>

#include "report/pictures/annotate.h"
#include "report/pictures/curves.h"
#include "report/report_style.h"
#include "results/file_io.h"

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
  // What holds for every run says nothing about what the study is meant to show.
  const bool general = std::all_of(content.criteria.begin(), content.criteria.end(),
                                   [](const auto& c) { return c.id.starts_with("INV.") || c.id.starts_with("LIMIT."); });
  const bool all = passed == static_cast<std::ptrdiff_t>(content.criteria.size());
  add(out, "<section>\n<h2>", general ? "Numerical checks" : "Verdict", "</h2>\n<p class=\"", all ? "badge good" : "badge bad", "\">",
      std::to_string(passed), " of ", std::to_string(content.criteria.size()), general ? " checks passed</p>\n" : " criteria passed</p>\n");
  std::vector<Row> rows;
  for (const auto& c : content.criteria)
    rows.push_back(
        {{c.id, c.text, display_text(c.value), display_text(c.limit), c.passed ? "✓ passed" : "✗ failed"}, c.passed ? "good" : "bad"});
  add_table(out, {"id", general ? "check" : "criterion", "value", "limit", "result"}, rows);
  add(out, "</section>\n");
}

void add_not_checked(std::string& out, const ReportContent& content) {
  if (content.not_checked.empty()) return;
  add(out, "<section>\n<h2>Not checked</h2>\n");
  std::vector<Row> rows;
  for (const NotChecked& n : content.not_checked) rows.push_back({{n.id, n.what, n.why}});
  add_table(out, {"id", "what", "why"}, rows);
  add(out, "</section>\n");
}

void add_key_numbers(std::string& out, const ReportContent& content) {
  if (content.key_numbers.empty()) return;
  add(out, "<section>\n<h2>Key numbers</h2>\n<dl class=\"numbers\">\n");
  for (const auto& n : content.key_numbers)
    add(out, "<div><dt>", xml_escaped(n.name), "</dt><dd>", xml_escaped(n.value), " <small>", xml_escaped(n.unit), "</small></dd></div>\n");
  add(out, "</dl>\n</section>\n");
}

void add_tables(std::string& out, const ReportContent& content) {
  for (const ReportTable& table : content.tables) {
    add(out, "<section>\n<h2>", xml_escaped(table.title), "</h2>\n");
    if (!table.note.empty()) add(out, "<p>", xml_escaped(table.note), "</p>\n");
    std::vector<Row> rows;
    for (const auto& cells : table.rows) rows.push_back({cells});
    add_table(out, table.header, rows);
    add(out, "</section>\n");
  }
}

void add_figure(std::string& out, const EncodedPicture& picture, bool hidden) {
  const std::string caption = xml_escaped(picture.caption);
  add(out, hidden ? "<figure hidden=\"hidden\">" : "<figure>", "<img src=\"data:image/png;base64,", base64(picture.png), "\" width=\"",
      std::to_string(picture.width), "\" height=\"", std::to_string(picture.height), "\" alt=\"", caption, "\"/><figcaption>", caption,
      "</figcaption></figure>\n");
}

/// The row a frame belongs to: its name without the number at the end.
std::string_view row_of(const EncodedPicture& picture) {
  const std::string_view name = picture.name;
  return name.substr(0, name.find_last_not_of("0123456789") + 1);
}

/// Frames of one row with a slider; the last is shown first.
void add_film(std::string& out, std::span<const EncodedPicture* const> frames) {
  // The slider shows the figure of its number. No `<` and no `&` in the script: the page stays well-formed.
  static constexpr const char* kShow =
      "var f=this.parentNode.parentNode.getElementsByTagName('figure');for(var i=0;i!=f.length;i+=1)f[i].hidden=(i!=this.value)";
  add(out, "<div class=\"film\">\n");
  for (const EncodedPicture* frame : frames) add_figure(out, *frame, frame != frames.back());
  if (frames.size() > 1)
    add(out, "<label>", xml_escaped(short_time(frames.front()->time)), " <input type=\"range\" min=\"0\" max=\"",
        std::to_string(frames.size() - 1), "\" value=\"", std::to_string(frames.size() - 1), "\" aria-label=\"time\" oninput=\"", kShow,
        "\"/> ", xml_escaped(short_time(frames.back()->time)), "</label>\n");
  add(out, "</div>\n");
}

void add_films(std::string& out, const ReportContent& content) {
  std::vector<std::vector<const EncodedPicture*>> films;
  for (const EncodedPicture& picture : content.pictures) {
    if (!picture.frame) continue;
    if (films.empty() || row_of(*films.back().back()) != row_of(picture)) films.emplace_back();
    films.back().push_back(&picture);
  }
  if (films.empty()) return;
  add(out, "<section>\n<h2>Over time</h2>\n<div class=\"large\">\n");
  for (const auto& film : films) add_film(out, film);
  add(out, "</div>\n</section>\n");
}

void add_final_pictures(std::string& out, const ReportContent& content) {
  if (std::all_of(content.pictures.begin(), content.pictures.end(), [](const EncodedPicture& picture) { return picture.frame; })) return;
  add(out, "<section>\n<h2>Final state</h2>\n<div class=\"large\">\n");
  for (const EncodedPicture& picture : content.pictures)
    if (!picture.frame) add_figure(out, picture, false);
  add(out, "</div>\n</section>\n");
}

void add_plots(std::string& out, const ReportContent& content, bool numerics) {
  const auto wanted = [&](const ReportPlot& plot) { return plot.numerics == numerics; };
  if (std::none_of(content.plots.begin(), content.plots.end(), wanted)) return;
  add(out, numerics ? "<details>\n<summary>Steps and solver</summary>\n" : "<section>\n<h2>Curves</h2>\n", "<div class=\"plots\">\n");
  for (const ReportPlot& plot : content.plots)
    if (wanted(plot))
      add(out, "<figure>", plot.svg, plot.caption.empty() ? "" : "<figcaption>" + xml_escaped(plot.caption) + "</figcaption>",
          "</figure>\n");
  add(out, numerics ? "</div>\n</details>\n" : "</div>\n</section>\n");
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

void add_exchanges(std::string& out, const ReportContent& content) {
  if (content.exchanges.empty()) return;
  add(out,
      "<section>\n<h2>What exchanges of bodies did</h2>\n<p>A ball overlaps its neighbours' behind the planes of its contacts, a shell "
      "does not: room is that of these caps. Jump: how far the middle of a cell went while its new shell found its shape among neighbours "
      "that were held, at once. Forces: change of the force on a neighbour before anyone else moved. Ways: of the neighbours within ten "
      "minutes, whatever else moved them.</p>\n");
  std::vector<Row> rows;
  const auto both = [](double largest, double mean) { return short_number(largest) + ", " + short_number(mean); };
  for (const ReportExchanges& e : content.exchanges)
    rows.push_back(
        {{e.kind, std::to_string(e.count), short_number(e.room) + " µm³", e.measured > 0 ? short_number(e.largest_own_way) + " R" : "–",
          e.measured > 0 ? both(e.largest_force, e.mean_force) + " nN" : "–",
          e.settled > 0 ? both(e.largest_way, e.mean_way) + " R (" + std::to_string(e.settled) + ")" : "–"}});
  add_table(out,
            {"exchange", "count", "room in all", "largest jump", "force on a neighbour: largest, mean",
             "way of a neighbour: largest, mean (of how many)"},
            rows);
  add(out, "</section>\n");
}

void add_methods(std::string& out, const ReportContent& content) {
  if (content.laws.empty()) return;
  add(out,
      "<section>\n<h2>Methods</h2>\n<p>Laws this run used. Lengths in µm, forces in nN, times in s, amounts in amol. "
      "<code>methods.md</code> says which values the study gave and where the others come from.</p>\n");
  for (const UsedLaw& use : content.laws) {
    add(out, "<article>\n<h3>", xml_escaped(use.law.title.empty() ? use.law.name : use.law.title), " <small>", xml_escaped(use.purpose),
        "</small></h3>\n");
    if (!use.law.equation.empty()) add(out, "<p class=\"equation\">", xml_escaped(use.law.equation), "</p>\n");
    if (!use.law.source.empty()) add(out, "<p class=\"source\">", xml_escaped(use.law.source), "</p>\n");
    std::vector<Row> rows;
    for (const LawParameter& p : use.law.parameters) rows.push_back({{p.name, used_value(use, p), p.unit, p.doc}});
    if (!rows.empty()) add_table(out, {"parameter", "value", "unit", "meaning"}, rows);
    add(out, "</article>\n");
  }
  add(out, "</section>\n");
}

void add_folded_text(std::string& out, const char* summary, const std::string& text) {
  if (!text.empty()) add(out, "<details>\n<summary>", summary, "</summary>\n<pre>", xml_escaped(text), "</pre>\n</details>\n");
}

void add_study(std::string& out, const ReportContent& content) {
  if (content.study_text.empty() && content.parameters_text.empty()) return;
  add(out, "<section>\n<h2>Study</h2>\n");
  add_folded_text(out, "The study as it was given", content.study_text);
  add_folded_text(out, "All parameters, with every default", content.parameters_text);
  add(out, "</section>\n");
}

void add_citation(std::string& out, const ReportContent& content) {
  if (content.citation.empty()) return;
  add(out, "<section>\n<h2>How to cite</h2>\n<p>", xml_escaped(content.citation), "</p>\n<pre>", xml_escaped(content.bibtex),
      "</pre>\n</section>\n");
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

std::string report_html(const ReportContent& content) {
  std::string out;
  add_head(out, content);
  add_verdict(out, content);
  add_key_numbers(out, content);
  add_tables(out, content);
  add_films(out, content);
  add_final_pictures(out, content);
  add_plots(out, content, false);
  add_events(out, content);
  add_exchanges(out, content);
  add_limits(out, content);
  add_not_checked(out, content);
  add_plots(out, content, true);
  add_study(out, content);
  add_methods(out, content);
  add_provenance(out, content);
  add_citation(out, content);
  add(out, "</main>\n</body>\n</html>\n");
  return out;
}

Status write_report(const ReportContent& content, const std::filesystem::path& path) {
  return write_file_atomically(path, report_html(content));
}

}  // namespace morula::scenarios
