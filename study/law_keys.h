#pragma once
#include <map>
#include <string>
#include <vector>

#include "coupling/laws.h"
#include "study/section.h"

namespace morula::scenarios {

struct BuildContext;

/// A law that a study chooses by a word, with the keys that it has for itself.
struct ChoosableLaw {
  std::string word;
  const std::vector<KeySpec>* keys = nullptr;
};
using ChoosableLaws = std::vector<ChoosableLaw>;

ChoosableLaws choosable_sphere_laws(const Laws& laws);
ChoosableLaws choosable_growth_laws(const Laws& laws);
ChoosableLaws choosable_surface_laws(const Laws& laws);
ChoosableLaws choosable_layer_laws(const Laws& laws, dcm::LayerWord::Of of);

/// What a study gives keys that laws have for themselves, by their names.
using LawKeyValues = std::map<std::string, Given<double>>;

/// Declares the keys that laws have for themselves, each once, but those that the section has already.
void declare_law_keys(Section& section, const ChoosableLaws& laws, std::vector<std::string> there, LawKeyValues& own);

/// What a key that laws have for themselves means where one of them is chosen.
struct LawKeyUse {
  std::vector<std::string> owners;  ///< words of the laws that have it, in their order
  bool has_effect = false;          ///< the chosen law is among them
  bool in_vain = false;             ///< it is given, and another law is chosen; its default may stand there, as in a resolved study
  const char* example = "";
};
LawKeyUse use_of(const std::string& name, const Given<double>& value, const ChoosableLaws& laws, const std::string& chosen);

/// E515 for keys of laws that are not the chosen one. `choice`: the key that chooses.
void check_law_keys(BuildContext& context, const LawKeyValues& own, const ChoosableLaws& laws, const std::string& chosen,
                    const std::string& choice);

}  // namespace morula::scenarios
