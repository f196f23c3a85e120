#include "app/laws.h"

#include <nlohmann/json.hpp>

#include "app/words.h"
#include "cbm/builtin.h"
#include "cbm/packing.h"
#include "coupling/behaviours/builtin.h"
#include "coupling/builtin.h"
#include "dcm/builtin.h"
#include "dcm/interior_laws.h"
#include "fields/builtin.h"

namespace morula::app {
namespace {

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
    out += "    " + p.name + " [" + (p.unit.empty() ? "1" : p.unit) + "]: " + p.doc + "\n";
  }
  return out;
}

std::string law_json(const ListedLaw& law) {
  nlohmann::ordered_json parameters = nlohmann::ordered_json::array();
  for (const LawParameter& p : law.info.parameters) {
    parameters.push_back({{"name", p.name}, {"quantity", p.quantity}, {"unit", p.unit}, {"doc", p.doc}});
  }
  const nlohmann::ordered_json json{{"law", law.info.name},          {"title", law.info.title},   {"group", law.group},
                                    {"equation", law.info.equation}, {"source", law.info.source}, {"parameters", parameters}};
  return json.dump(2) + "\n";
}

std::string law_reference() {
  std::string out =
      "# Laws\n\nGenerated from the registries (`cbm/builtin.cpp`, `dcm/builtin.cpp`, `coupling/builtin.cpp`, "
      "`coupling/behaviours/builtin.cpp`, `fields/builtin.cpp`); do not edit.\n"
      "Units inside are µm, nN, s and amol; 1 kPa = 1 nN/µm². Values, ranges, defaults and where these come from belong to the keys of the "
      "study\n"
      "and stand in [study_reference.md](study_reference.md) alone; `methods.md` of a run has the values it used.\n";
  std::string group;
  for (const ListedLaw& law : all_laws()) {
    if (law.group != group) {
      group = law.group;
      out += "\n## Laws of " + group + "\n";
    }
    out += "\n### `" + law.info.name + "`: " + law.info.title + "\n\n    " + law.info.equation + "\n\nSource: " + law.info.source + "\n";
    if (law.info.parameters.empty()) continue;
    out += "\n| parameter | unit | what |\n|---|---|---|\n";
    for (const LawParameter& p : law.info.parameters)
      out += "| `" + p.name + "` | " + (p.unit.empty() ? "1" : p.unit) + " | " + in_cell(p.doc) + " |\n";
  }
  return out;
}

}  // namespace morula::app
