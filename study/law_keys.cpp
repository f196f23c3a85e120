#include "study/law_keys.h"

#include <algorithm>

#include "coupling/behaviours/growth_law.h"
#include "study/build.h"
#include "study/layer_words.h"

namespace morula::scenarios {

ChoosableLaws choosable_sphere_laws(const Laws& laws) {
  ChoosableLaws out;
  for (const auto& law : laws.spheres) out.push_back({law->word, &law->own});
  return out;
}

ChoosableLaws choosable_growth_laws(const Laws& laws) {
  ChoosableLaws out;
  for (const auto& law : laws.growth) out.push_back({law->word, &law->own});
  return out;
}

ChoosableLaws choosable_surface_laws(const Laws& laws) {
  ChoosableLaws out;
  for (const auto& law : laws.surfaces) out.push_back({law->word, &law->own});
  return out;
}

ChoosableLaws choosable_layer_laws(const Laws& laws, dcm::LayerWord::Of of) {
  ChoosableLaws out;
  for (const dcm::LayerWord* word : layer_words(laws, of)) out.push_back({word->word, &word->keys});
  return out;
}

void declare_law_keys(Section& section, const ChoosableLaws& laws, std::vector<std::string> there, LawKeyValues& own) {
  for (const ChoosableLaw& law : laws)
    for (const KeySpec& key : *law.keys) {
      if (std::ranges::find(there, key.name) != there.end()) continue;
      there.emplace_back(key.name);
      section.quantity(key, own[key.name]);
    }
}

LawKeyUse use_of(const std::string& name, const Given<double>& value, const ChoosableLaws& laws, const std::string& chosen) {
  LawKeyUse use;
  bool is_default = false;
  for (const ChoosableLaw& law : laws)
    for (const KeySpec& key : *law.keys) {
      if (name != key.name) continue;
      use.owners.push_back(law.word);
      use.has_effect = use.has_effect || law.word == chosen;
      use.example = key.example;
      is_default = key.fallback != nullptr && value.text == key.fallback;
    }
  use.in_vain = !use.owners.empty() && !use.has_effect && value.given && !is_default;
  return use;
}

void check_law_keys(BuildContext& c, const LawKeyValues& own, const ChoosableLaws& laws, const std::string& chosen,
                    const std::string& choice) {
  for (const auto& [name, key] : own) {
    const LawKeyUse use = use_of(name, key, laws, chosen);
    if (!use.in_vain) continue;
    std::string owners;
    for (const std::string& word : use.owners) owners += (owners.empty() ? "`" : " or `") + choice + ": " + word + "`";
    c.diagnostics.error(515, key.place, "'" + name + "' has no effect here", "it belongs to " + owners);
  }
}

}  // namespace morula::scenarios
