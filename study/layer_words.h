#pragma once
#include <string>
#include <vector>

#include "coupling/laws.h"
#include "study/draft.h"

namespace morula::scenarios {

/// The words of `elastic` or of `bending`, in the order of the laws.
std::vector<const dcm::LayerWord*> layer_words(const Laws& laws, dcm::LayerWord::Of of);
/// The law that a word chooses; null for `none` and for what is no word.
const dcm::LayerWord* find_layer_word(const Laws& laws, dcm::LayerWord::Of of, const std::string& word);
/// The words of `elastic` whose laws resist changes of area, separated by commas.
std::string area_words(const Laws& laws);

/// What a layer of a shell gives its law: the keys of all layers and those of the law's own. The first layer has those of ShellKeys as well.
LawValues layer_values(const draft::Layer& layer, const dcm::LayerWord& word);
LawValues layer_values(const draft::ShellKeys& shell, const dcm::LayerWord& word);
/// The values of the laws that every shell has.
LawValues shell_values(const draft::ShellKeys& shell, double medium_friction);

}  // namespace morula::scenarios
