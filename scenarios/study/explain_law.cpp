#include "scenarios/study/explain_law.h"

#include <cmath>

#include "cbm/builtin.h"
#include "dcm/builtin.h"
#include "scenarios/study/read_section.h"

namespace morula::scenarios {
namespace {

std::vector<LawInfo> all_laws() {
  std::vector<LawInfo> laws;
  for (const auto& entry : cbm::contact_laws()) laws.push_back(entry.info);
  for (const auto& law : dcm::shell_laws()) laws.push_back(law.info);
  return laws;
}

std::string parameter_text(const LawParameter& p) {
  const std::string unit = p.unit == "1" ? "" : " " + p.unit;
  std::string out = "  " + p.name + ": " + p.doc + " [" + p.quantity + (unit.empty() ? "" : "," + unit) + "]";
  if (std::isfinite(p.minimum)) out += ", at least " + short_number(p.minimum) + unit;
  if (std::isfinite(p.maximum)) out += ", at most " + short_number(p.maximum) + unit;
  if (p.fallback) out += ", default " + short_number(*p.fallback) + unit;
  if (!p.source.empty()) out += " (" + p.source + ")";
  return out + "\n";
}

}  // namespace

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const LawInfo& law : all_laws()) names.push_back(law.name);
  return names;
}

std::optional<std::string> explain_law(const std::string& name) {
  for (const LawInfo& law : all_laws()) {
    if (law.name != name) continue;
    std::string out = law.name + ": " + law.title + "\n  " + law.equation + "\n  source: " + law.source + "\n";
    for (const LawParameter& parameter : law.parameters) out += parameter_text(parameter);
    return out;
  }
  return std::nullopt;
}

}  // namespace morula::scenarios
