#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/mesh/renewal/own_mesh.h"
#include "dcm/derived_parameters.h"
#include "study/build.h"
#include "study/law_keys.h"
#include "study/layer_words.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

using Of = dcm::LayerWord::Of;

/// Laws of one shell that resist changes of its area may add only when the study says so.
void check_area(BuildContext& c, const std::string& type, const draft::ShellKeys& t) {
  if (t.area_on_top.value) return;
  std::vector<std::pair<std::string, Place>> laws;
  const auto add = [&](const Given<std::string>& elastic, const char* section) {
    const dcm::LayerWord* word = find_layer_word(*c.options.laws, Of::kElastic, elastic.value);
    if (word != nullptr && word->resists_area)
      laws.emplace_back(std::string("`") + section + ".elastic: " + elastic.value + "`", elastic.place);
  };
  add(t.elastic, "cortex");
  if (t.has_membrane) add(t.membrane.elastic, "membrane");
  if (t.local_area.value > 0.0) laws.emplace_back("`area.local`", t.local_area.place);
  if (t.global_area.value > 0.0) laws.emplace_back("`area.global`", t.global_area.place);
  if (laws.size() < 2) return;
  c.diagnostics.error(513, laws.back().second,
                      "shells of '" + type + "' resist changes of area twice: by " + laws.front().first + " and by " + laws.back().first,
                      "leave one away, or write `area: {on_top: true, ...}` if the moduli shall add");
}

/// Keys of a law that is not the chosen one.
void check_effect(BuildContext& c, const draft::ShellKeys& t) {
  const auto without_effect = [&](const Given<double>& key, const char* name, const std::string& needs) {
    const bool is_default = key.value == kAuto || std::isinf(key.value);  // auto; never
    if (key.given && !is_default)
      c.diagnostics.error(515, key.place, std::string("'") + name + "' has no effect here", "it belongs to " + needs);
  };
  const Laws& laws = *c.options.laws;
  check_law_keys(c, t.own, choosable_layer_laws(laws, Of::kElastic), t.elastic.value, "elastic");
  check_law_keys(c, t.own, choosable_layer_laws(laws, Of::kBending), t.bending_law.value, "law");
  if (t.bending_law.value == "none") without_effect(t.bending, "rigidity", "a law of `bending`");
  if (!resists_in_plane(t)) without_effect(t.turnover, "turnover", "a cortex that is elastic in its plane");
}

/// What a second layer must say of itself, and what it must not.
void check_membrane(BuildContext& c, const draft::ShellKeys& t) {
  const draft::Layer& m = t.membrane;
  const dcm::LayerWord* elastic = find_layer_word(*c.options.laws, Of::kElastic, m.elastic.value);
  const auto need = [&](const Given<double>& key, const std::string& name, const Given<std::string>& word, bool needed,
                        const std::string& law) {
    if (needed && !key.given)
      c.diagnostics.error(103, word.place, "the membrane's '" + word.value + "' needs '" + name + "'", "add `" + name + "`");
    if (!needed && key.given) c.diagnostics.error(515, key.place, "'" + name + "' has no effect here", "it belongs to " + law);
  };
  std::string with_ratio;
  for (const dcm::LayerWord* word : layer_words(*c.options.laws, Of::kElastic))
    if (word->has_area_ratio) with_ratio += (with_ratio.empty() ? "`elastic: " : ", `") + word->word + "`";
  need(m.own.at("shear_modulus"), "shear_modulus", m.elastic, elastic != nullptr, "an `elastic` law");
  need(m.own.at("area_ratio"), "area_ratio", m.elastic, elastic != nullptr && elastic->has_area_ratio, with_ratio);
  need(m.bending, "rigidity", m.bending_law, m.bending_law.value != "none", "a law of `bending`");
  LawKeyValues own = m.own;  // the two that all sheets have are looked at above
  own.erase("shear_modulus"), own.erase("area_ratio");
  const Laws& laws = *c.options.laws;
  check_law_keys(c, own, choosable_layer_laws(laws, Of::kElastic), m.elastic.value, "elastic");
  check_law_keys(c, own, choosable_layer_laws(laws, Of::kBending), m.bending_law.value, "bending");
  if (m.elastic.value == "none" && m.bending_law.value == "none")
    c.diagnostics.error(515, m.elastic.place, "a membrane without a law has no effect", "give it `elastic` or `bending`, or remove it");
}

/// The value of a key of a layer, for a message.
const Given<double>* find_key(const draft::Layer& layer, const draft::ShellKeys& t, const std::string& name) {
  if (const auto own = layer.own.find(name); own != layer.own.end()) return &own->second;
  if (name == "rigidity") return &layer.bending;
  return name == "young" ? &t.young : name == "thickness" ? &t.thickness : name == "poisson" ? &t.poisson : nullptr;
}

/// Adds the law of a layer to the shell.
template <class Keys>
void add_layer(BuildContext& c, const draft::ShellKeys& t, const Keys& layer, Of of, const std::string& chosen, dcm::ShellParameters& p) {
  const dcm::LayerWord* word = find_layer_word(*c.options.laws, of, chosen);
  if (word == nullptr) return;
  const LawValues values = layer_values(layer, *word);
  if (const auto problem = word->judge != nullptr ? word->judge(values, p) : std::nullopt) {
    const Given<double>* key = find_key(layer, t, problem->key);
    std::string what = problem->what;
    if (const std::size_t gap = what.find("{}"); key != nullptr && gap != std::string::npos) what.replace(gap, 2, key->text);
    if (key == nullptr || key->known())
      c.diagnostics.error(problem->code, key != nullptr ? key->place : t.elastic.place, what, problem->help);
  }
  word->build(values, p);
}

/// A fluid cortex has no shear modulus but that of the shape term.
void check_shape(BuildContext& c, const std::string& type, const draft::ShellKeys& t) {
  if (resists_in_plane(t) || !t.tension.known() || !(t.tension.value > 0.0) || !t.shape_stiffness.known()) return;
  const double ratio = t.shape_stiffness.value / t.tension.value;
  if (ratio <= dcm::kStiffShape * (1.0 + 1e-9)) return;
  c.diagnostics.warning(640, t.shape_stiffness.place,
                        "a `shape_stiffness` of " + short_number(ratio) + " times the tension holds the fluid cortex of '" + type +
                            "' back like an elastic one: contact radii and angles come out too small (3 times: 3.8 % and 4 deg)",
                        "0.3 times the tension, which is the default, or at most 0.6 times");
}

}  // namespace

bool resists_in_plane(const draft::ShellKeys& t) {
  return t.elastic.value != "none" || (t.has_membrane && t.membrane.elastic.value != "none") ||
         t.local_area.value + t.global_area.value > 0.0;
}

double build_mesh_renewal(BuildContext& c, const draft::CellType& t, const CellType& type) {
  const auto& below = t.renew_mesh_below;
  if (!below.known() || below.value == 0.0) return 0.0;
  const auto hangs = [&](const std::string& what, const std::string& help) {
    c.diagnostics.error(584, below.place, "the nodes of '" + type.name + "' are to slide along its surface, but " + what, help);
  };
  if (type.interior.nucleus_links.act() || type.interior.cortex_links.act())
    hangs("its links hold them by their numbers", "`renew_mesh_below: never`, or no links");
  if (type.shell.local_area_modulus > 0.0)
    hangs("its faces have an area modulus each", "`renew_mesh_below: never`, or `area: {global: …}`");
  return below.value;
}

bool build_own_mesh(BuildContext& c, const draft::CellType& t, const CellType& type) {
  if (!t.own_mesh.value) return false;
  if (t.renew_mesh_below.known() && t.renew_mesh_below.value == 0.0)
    c.diagnostics.error(515, t.own_mesh.place, "`own_mesh` of '" + type.name + "' has no effect: its meshes are never renewed",
                        "`renew_mesh_below: 0.4`, or leave `own_mesh` away");
  return true;
}

double build_self_contact(BuildContext& c, const draft::CellType& t) {
  if (!t.self_contact.known() || t.self_contact.value == 0.0 || !t.radius.mean.known() || !t.nodes.known()) return 0.0;
  const double faces = 2.0 * static_cast<double>(t.nodes.value) - 4.0;
  const double even = 4.0 * t.radius.mean.value * std::sqrt(std::numbers::pi / (std::numbers::sqrt3 * faces));
  const double edge = t.own_mesh.value ? OwnMeshLimits{}.finest * even : even;  // a mesh of its own is finer where the surface is curved
  if (t.self_contact.value < 0.0) {
    const bool has_meshes = std::ranges::any_of(c.draft.initial, [](const auto& block) { return block.content.has_meshes; });
    return has_meshes ? 0.0 : 0.25 * edge;  // a mesh that comes with the study may be much finer than the type's
  }
  if (t.self_contact.value <= 0.5 * edge) return t.self_contact.value;
  c.diagnostics.error(582, t.self_contact.place,
                      "a self-contact at " + t.self_contact.text + " reaches the neighbouring faces: edges of " + t.nodes.text +
                          " nodes are " + short_number(std::round(100.0 * edge) / 100.0) + " um long" +
                          (t.own_mesh.value ? " at the least" : ""),
                      "at most " + short_number(std::floor(50.0 * edge) / 100.0) + " um, or fewer `nodes`");
  return 0.0;
}

dcm::ShellParameters build_shell(BuildContext& c, const std::string& type_name, const draft::ShellKeys& t, double medium_friction) {
  dcm::ShellParameters p;
  add_layer(c, t, t, Of::kElastic, t.elastic.value, p);
  add_layer(c, t, t, Of::kBending, t.bending_law.value, p);
  if (t.has_membrane) {
    check_membrane(c, t);
    add_layer(c, t, t.membrane, Of::kElastic, t.membrane.elastic.value, p);
    add_layer(c, t, t.membrane, Of::kBending, t.membrane.bending_law.value, p);
  }
  check_area(c, type_name, t);
  check_effect(c, t);
  const LawValues values = shell_values(t, medium_friction);
  for (const dcm::ShellLaw& law : c.options.laws->shells)
    if (law.build != nullptr) law.build(values, p);
  check_shape(c, type_name, t);
  return p;
}

}  // namespace morula::scenarios
