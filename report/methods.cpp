#include "report/methods.h"

#include "report/pictures/annotate.h"

namespace morula::scenarios {
namespace {

// A cell of a Markdown table: no line breaks, pipes escaped; HTML is shown, not obeyed.
std::string table_cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|')
      out += "\\|";
    else if (c == '<')
      out += "&lt;";
    else
      out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out;
}

void add_parameters(const UsedLaw& use, std::string& out) {
  if (use.law.parameters.empty()) return;
  out += "\n| parameter | value | unit | meaning |\n|---|---|---|---|\n";
  for (const LawParameter& parameter : use.law.parameters)
    for (const std::string& cell : {std::string("| ") + table_cell(parameter.name), table_cell(used_value(use, parameter)),
                                    table_cell(parameter.unit), table_cell(parameter.doc) + " |\n"})
      out.append(cell).append(cell.ends_with("\n") ? "" : " | ");
}

}  // namespace

std::string used_value(const UsedLaw& use, const LawParameter& parameter) {
  for (const auto& [name, value] : use.values)
    if (name == parameter.name) return short_number(value, 6);
  return parameter.is_fixed() ? short_number(*parameter.fallback, 6) : "not set";
}

std::string methods_text(const std::string& title, std::span<const UsedLaw> laws, const std::string& resolved) {
  std::string out = "# Methods: ";
  out.append(table_cell(title))
      .append(
          "\n\nLaws this run used, with the values that the model had. Lengths in µm, forces in nN, times in s, amounts in amol, unless "
          "said "
          "otherwise. Which of them the study gave, which are defaults and where those come from is said at the end.\n");
  const std::string* purpose = nullptr;
  for (const UsedLaw& use : laws) {
    if (!purpose || *purpose != use.purpose) out.append("\n## ").append(table_cell(use.purpose)).append("\n");
    purpose = &use.purpose;
    out.append("\n### ")
        .append(table_cell(use.law.title.empty() ? use.law.name : use.law.title))
        .append(" (`")
        .append(use.law.name)
        .append("`)\n\n");
    if (!use.law.equation.empty()) out.append("    ").append(table_cell(use.law.equation)).append("\n\n");
    if (!use.law.source.empty()) out.append("Source: ").append(table_cell(use.law.source)).append("\n");
    add_parameters(use, out);
  }
  out +=
      "\n## Where the values come from\n\nThe study with all its keys. A value without a remark was given; `default` is followed by the "
      "source of the "
      "default. What a law names and no key does (such as the stiffness of an edge) follows from these by the law's equation.\n\n```yaml\n";
  return out + resolved + (resolved.ends_with('\n') ? "```\n" : "\n```\n");
}

}  // namespace morula::scenarios
