#include "app/laws.h"

#include <nlohmann/json.hpp>

#include "app/words.h"
#include "cbm/builtin.h"
#include "cbm/crowded_area.h"
#include "cbm/packing.h"
#include "coupling/behaviours/arrest.h"
#include "coupling/behaviours/behaviour.h"
#include "coupling/behaviours/builtin.h"
#include "coupling/behaviours/division_axis.h"
#include "coupling/behaviours/growth_law.h"
#include "coupling/behaviours/migration_law.h"
#include "coupling/behaviours/polarity_rule.h"
#include "coupling/builtin.h"
#include "coupling/loads/load.h"
#include "coupling/regions/region.h"
#include "dcm/interior_laws.h"
#include "fields/builtin.h"
#include "fields/reaction.h"
#include "study/key_range.h"

namespace morula::app {
namespace {

/// A text within a cell of a Markdown table.
std::string in_cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : c == '\n' ? std::string(" ") : std::string(1, c);
  return out;
}

std::string path_of(const LawKey& key) { return key.section.empty() ? key.spec.name : key.section + "." + key.spec.name; }

std::string fallback_of(const KeySpec& key) {
  if (key.fallback == nullptr) return key.required ? "none, must be given" : "none";
  return "`" + std::string(key.fallback) + "`";
}

}  // namespace

std::vector<ListedLaw> all_laws(const Laws& registered) {
  std::vector<ListedLaw> laws;
  for (const auto& law : registered.spheres) laws.push_back({"contact of spheres", law->info});
  laws.push_back({"contact of spheres", cbm::jkr_range_law()});
  laws.push_back({"contact of spheres", cbm::packing_law()});
  laws.push_back({"contact of spheres", cbm::crowded_area_law()});
  for (const auto& law : registered.shells) laws.push_back({"shells", law.info});
  const auto add = [&laws](const char* group, std::vector<LawInfo> infos) {
    for (LawInfo& info : infos) laws.push_back({group, std::move(info)});
  };
  for (const auto& law : registered.surfaces) laws.push_back({"contact of surfaces", law->info});
  add("contact of surfaces", surface_contact_terms());
  add("interior of shells", dcm::interior_laws());
  for (const auto& law : registered.growth) laws.push_back({"growth", law->info});
  for (const auto& factor : registered.arrest) {
    laws.push_back({"growth", factor->info});
    laws.back().info.keys = law_keys("cycle.arrest." + std::string(factor->section.name), factor->keys);
  }
  add("behaviours", behaviour_laws());
  for (const auto& behaviour : registered.behaviours) {
    laws.push_back({"behaviours", behaviour->info});
    laws.back().info.keys = law_keys(behaviour->section.name, behaviour->keys);
  }
  for (const auto& axis : registered.division_axes) {
    laws.push_back({"axes of division", axis->info});
    laws.back().info.keys = law_keys("cycle", axis->keys);
  }
  for (const auto& law : registered.migration) {
    laws.push_back({"migration", law->info});
    laws.back().info.keys = law_keys("migration", law->keys);
  }
  for (const auto& rule : registered.polarity) {
    laws.push_back({"polarity", rule->info});
    laws.back().info.keys = law_keys("polarity", rule->keys);
  }
  add("fields", fields::field_laws());
  for (const auto& reaction : registered.reactions) {
    const bool of_cells = reaction->where == fields::Reaction::Where::kCells;
    const std::string field = "fields.<name>", section = field + "." + reaction->section.name + (of_cells ? ".<type>" : "");
    laws.push_back({"fields", reaction->info});
    laws.back().info.keys = law_keys(reaction->bare ? field : section, reaction->keys);
  }
  for (const auto& load : registered.loads) {
    laws.push_back({"loads", load->info});
    laws.back().info.keys = law_keys(load->bare ? "loads.<name>" : "loads.<name>." + std::string(load->section.name), load->keys);
  }
  for (const auto& shape : registered.region_shapes) {
    laws.push_back({"regions", shape->info});
    laws.back().info.keys = law_keys("coupling.regions[]", shape->keys);
  }
  for (const auto& value : registered.trigger_values) laws.push_back({"triggers", value->info});
  add("activity", active_laws());
  return laws;
}

std::vector<ListedLaw> laws_named(const Laws& laws, const std::string& name) {
  std::vector<ListedLaw> found;
  for (ListedLaw& law : all_laws(laws))
    if (law.info.name == name) found.push_back(std::move(law));
  return found;
}

std::vector<std::string> law_names(const Laws& laws) {
  std::vector<std::string> names;
  for (const ListedLaw& law : all_laws(laws)) names.push_back(law.info.name);
  return names;
}

std::string law_text(const ListedLaw& law) {
  std::string out = law.info.name + ": " + law.info.title + " (" + law.group + ")\n  equation: " + law.info.equation +
                    "\n  source:   " + law.info.source + "\n";
  if (!law.info.parameters.empty()) out += "  parameters:\n";
  for (const LawParameter& p : law.info.parameters) {
    out += "    " + p.name + " [" + (p.unit.empty() ? "1" : p.unit) + "]: " + p.doc + "\n";
  }
  if (!law.info.keys.empty()) out += "  from the keys of the study:\n";
  for (const LawKey& key : law.info.keys) {
    out += "    " + path_of(key) + ": " + key.spec.doc +
           (scenarios::allowed_values(key.spec).empty() ? "" : "\n      range:   " + scenarios::allowed_values(key.spec)) +
           "\n      default: " + fallback_of(key.spec) + "\n";
  }
  return out;
}

std::string law_json(const ListedLaw& law) {
  nlohmann::ordered_json parameters = nlohmann::ordered_json::array();
  for (const LawParameter& p : law.info.parameters) {
    parameters.push_back({{"name", p.name}, {"quantity", p.quantity}, {"unit", p.unit}, {"doc", p.doc}});
  }
  nlohmann::ordered_json keys = nlohmann::ordered_json::array();
  for (const LawKey& key : law.info.keys)
    keys.push_back({{"key", path_of(key)},
                    {"default", key.spec.fallback != nullptr ? key.spec.fallback : ""},
                    {"range", scenarios::allowed_values(key.spec)},
                    {"source", key.spec.source},
                    {"doc", key.spec.doc}});
  const nlohmann::ordered_json json{
      {"law", law.info.name},      {"title", law.info.title},  {"group", law.group}, {"equation", law.info.equation},
      {"source", law.info.source}, {"parameters", parameters}, {"keys", keys}};
  return json.dump(2) + "\n";
}

std::string law_reference(const Laws& laws) {
  std::string out =
      "# Laws\n\nGenerated from the declarations of the laws; do not edit.\n"
      "Units inside are µm, nN, s and amol; 1 kPa = 1 nN/µm². Parameters are the numbers that a law's functions take; they follow from "
      "keys "
      "of the\n"
      "study ([study_reference.md](study_reference.md)), and `methods.md` of a run has the values it used.\n";
  std::string group;
  for (const ListedLaw& law : all_laws(laws)) {
    if (law.group != group) {
      group = law.group;
      out += "\n## Laws of " + group + "\n";
    }
    out += "\n### `" + law.info.name + "`: " + law.info.title + "\n\n    " + law.info.equation + "\n\nSource: " + law.info.source + "\n";
    if (!law.info.parameters.empty()) out += "\n| parameter | unit | what |\n|---|---|---|\n";
    for (const LawParameter& p : law.info.parameters)
      out += "| `" + p.name + "` | " + (p.unit.empty() ? "1" : p.unit) + " | " + in_cell(p.doc) + " |\n";
    if (!law.info.keys.empty()) out += "\n| key of the study | range | default | source |\n|---|---|---|---|\n";
    for (const LawKey& key : law.info.keys)
      out += "| `" + path_of(key) + "` | " + scenarios::allowed_values(key.spec) + " | " + fallback_of(key.spec) + " | " +
             in_cell(key.spec.source) + " |\n";
  }
  return out;
}

}  // namespace morula::app
