#include "study/layer_words.h"

#include <ranges>

#include "core/numbers/joined.h"

namespace morula::scenarios {
namespace {

/// A key that says `auto` leaves its value to the law.
void set(LawValues& values, const char* name, const Given<double>& key) {
  if (key.known() && key.value == kAuto && key.text == "auto") return;
  values.set(name, key.value);
}

}  // namespace

std::vector<const dcm::LayerWord*> layer_words(const Laws& laws, dcm::LayerWord::Of of) {
  std::vector<const dcm::LayerWord*> out;
  for (const dcm::ShellLaw& law : laws.shells)
    for (const dcm::LayerWord& word : law.words)
      if (word.of == of) out.push_back(&word);
  return out;
}

const dcm::LayerWord* find_layer_word(const Laws& laws, dcm::LayerWord::Of of, const std::string& word) {
  for (const dcm::LayerWord* one : layer_words(laws, of))
    if (one->word == word) return one;
  return nullptr;
}

std::string area_words(const Laws& laws) {
  const auto resists = [](const dcm::LayerWord* word) { return word->resists_area; };
  return joined(layer_words(laws, dcm::LayerWord::Of::kElastic) | std::views::filter(resists), &dcm::LayerWord::word);
}

LawValues layer_values(const draft::Layer& layer, const dcm::LayerWord& word) {
  LawValues out;
  set(out, "rigidity", layer.bending);
  for (const char* name : {"shear_modulus", "area_ratio"})
    if (const auto at = layer.own.find(name); at != layer.own.end() && at->second.given) set(out, name, at->second);
  for (const KeySpec& key : word.keys)
    if (const auto at = layer.own.find(key.name); at != layer.own.end()) set(out, key.name, at->second);
  return out;
}

LawValues layer_values(const draft::ShellKeys& shell, const dcm::LayerWord& word) {
  LawValues out;
  set(out, "young", shell.young), set(out, "thickness", shell.thickness), set(out, "poisson", shell.poisson);
  set(out, "rigidity", shell.bending);
  for (const KeySpec& key : word.keys)
    if (const auto at = shell.own.find(key.name); at != shell.own.end()) set(out, key.name, at->second);
  return out;
}

LawValues shell_values(const draft::ShellKeys& t, double medium_friction) {
  LawValues out;
  set(out, "young", t.young), set(out, "thickness", t.thickness), set(out, "poisson", t.poisson);
  set(out, "tension", t.tension), set(out, "turnover", t.turnover);
  set(out, "damping", t.damping), set(out, "isotropic_damping", t.isotropic_damping);
  set(out, "local", t.local_area), set(out, "global", t.global_area);
  set(out, "bulk_modulus", t.bulk_modulus), set(out, "bulk_viscosity", t.bulk_viscosity);
  set(out, "shape_stiffness", t.shape_stiffness);
  set(out, "stiffness", t.fold_stiffness), set(out, "angle", t.fold_angle);
  out.set("sheet_modulus", t.elastic.value == "none" ? 0.0 : t.young.value * t.thickness.value);
  out.set("medium", medium_friction);
  return out;
}

}  // namespace morula::scenarios
