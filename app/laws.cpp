#include "app/laws.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/words.h"
#include "cbm/builtin.h"
#include "cbm/packing.h"
#include "core/numbers/number_text.h"
#include "coupling/behaviours/builtin.h"
#include "coupling/builtin.h"
#include "dcm/builtin.h"
#include "dcm/interior_laws.h"
#include "fields/builtin.h"

namespace morula::app {
namespace {

std::string with_unit(double value, const std::string& unit) {
  return number_text("%.6g", value) + (unit == "1" || unit.empty() ? "" : " " + unit);
}

std::string default_of(const LawParameter& parameter) {
  return parameter.fallback ? with_unit(*parameter.fallback, parameter.unit) : "none";
}

std::string range_of(const LawParameter& parameter) {
  const bool low = std::isfinite(parameter.minimum), high = std::isfinite(parameter.maximum);
  if (!low && !high) return "any";
  if (low && high) return with_unit(parameter.minimum, "1") + " to " + with_unit(parameter.maximum, parameter.unit);
  return low ? "at least " + with_unit(parameter.minimum, parameter.unit) : "at most " + with_unit(parameter.maximum, parameter.unit);
}

/// A text within a cell of a Markdown table.
std::string in_cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : c == '\n' ? std::string(" ") : std::string(1, c);
  return out;
}

}  // namespace

std::vector<ListedLaw> all_laws() {
  std::vector<ListedLaw> laws;
  for (auto& entry : cbm::contact_laws()) laws.push_back({"contact of spheres", std::move(entry.info)});
  laws.push_back({"contact of spheres", cbm::jkr_range_law()});
  laws.push_back({"contact of spheres", cbm::packing_law()});
  for (const auto& entry : dcm::shell_laws()) laws.push_back({"shells", entry.info});
  const auto add = [&laws](const char* group, std::vector<LawInfo> infos) {
    for (LawInfo& info : infos) laws.push_back({group, std::move(info)});
  };
  add("contact of surfaces", surface_contact_laws());
  add("interior of shells", dcm::interior_laws());
  add("behaviours", behaviour_laws());
  add("fields", fields::field_laws());
  add("loads", load_laws());
  add("activity", active_laws());
  return laws;
}

std::vector<ListedLaw> laws_named(const std::string& name) {
  std::vector<ListedLaw> found;
  for (ListedLaw& law : all_laws())
    if (law.info.name == name) found.push_back(std::move(law));
  return found;
}

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const ListedLaw& law : all_laws()) names.push_back(law.info.name);
  return names;
}

std::string law_text(const ListedLaw& law) {
  std::string out = law.info.name + ": " + law.info.title + " (" + law.group + ")\n  equation: " + law.info.equation +
                    "\n  source:   " + law.info.source + "\n";
  if (law.info.parameters.empty()) return out;
  out += "  parameters:\n";
  for (const LawParameter& p : law.info.parameters) {
    out += "    " + p.name + " [" + (p.unit.empty() ? "1" : p.unit) + "]: " + p.doc + "\n      default " + default_of(p) + ", range " +
           range_of(p);
    out += p.source.empty() ? "\n" : "; source: " + p.source + "\n";
  }
  return out;
}

std::string law_json(const ListedLaw& law) {
  nlohmann::ordered_json parameters = nlohmann::ordered_json::array();
  for (const LawParameter& p : law.info.parameters) {
    nlohmann::ordered_json one{{"name", p.name}, {"quantity", p.quantity}, {"unit", p.unit}, {"doc", p.doc}, {"source", p.source}};
    one["default"] = p.fallback ? nlohmann::ordered_json(*p.fallback) : nlohmann::ordered_json(nullptr);
    one["minimum"] = std::isfinite(p.minimum) ? nlohmann::ordered_json(p.minimum) : nlohmann::ordered_json(nullptr);
    one["maximum"] = std::isfinite(p.maximum) ? nlohmann::ordered_json(p.maximum) : nlohmann::ordered_json(nullptr);
    parameters.push_back(std::move(one));
  }
  const nlohmann::ordered_json json{{"law", law.info.name},          {"title", law.info.title},   {"group", law.group},
                                    {"equation", law.info.equation}, {"source", law.info.source}, {"parameters", parameters}};
  return json.dump(2) + "\n";
}

std::string law_reference() {
  std::string out =
      "# Laws\n\nGenerated from the registries (`cbm/builtin.cpp`, `dcm/builtin.cpp`, `coupling/builtin.cpp`, "
      "`coupling/behaviours/builtin.cpp`, `fields/builtin.cpp`); do not edit.\n"
      "Units inside are µm, nN, s and amol; 1 kPa = 1 nN/µm².\n";
  std::string group;
  for (const ListedLaw& law : all_laws()) {
    if (law.group != group) {
      group = law.group;
      out += "\n## Laws of " + group + "\n";
    }
    out += "\n### `" + law.info.name + "`: " + law.info.title + "\n\n    " + law.info.equation + "\n\nSource: " + law.info.source + "\n";
    if (law.info.parameters.empty()) continue;
    out += "\n| parameter | unit | default | range | what | source |\n|---|---|---|---|---|---|\n";
    for (const LawParameter& p : law.info.parameters)
      out += "| `" + p.name + "` | " + (p.unit.empty() ? "1" : p.unit) + " | " + default_of(p) + " | " + range_of(p) + " | " +
             in_cell(p.doc) + " | " + in_cell(p.source) + " |\n";
  }
  return out;
}

}  // namespace morula::app
