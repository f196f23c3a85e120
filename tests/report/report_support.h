#pragma once
#include <limits>
#include <string>
#include <vector>

#include "report/pictures/curves.h"

namespace morula::scenarios::test {

/// Checks that text is well-formed XML: one root, tags nest, attributes quoted, no stray < or &. Empty when it is, else what is wrong.
inline std::string xml_fault(std::string_view text) {
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

inline constexpr const char* kNasty = "<script>alert('x')</script> & \"quotes\" \x01";

inline CurvePlot some_plot() {
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

}  // namespace morula::scenarios::test
