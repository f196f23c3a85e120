#pragma once
#include <optional>
#include <string>
#include <vector>

#include "study/section.h"

namespace morula::scenarios {

/// A key as it was declared, with its place in the study.
struct Declaration {
  enum class Kind {
    kQuantity,
    kWhole,
    kWord,
    kText,
    kFlag,
    kVector,
    kVectors,
    kWords,
    kComparison,
    kGroup,
    kNamed,
    kList,
    kQuantities,
    kOneOrMore,
    kAnyQuantity,
    kAnyQuantities
  };
  Kind kind = Kind::kGroup;
  KeySpec spec;
  std::string path;    ///< such as `cell_types.<name>.dcm.cortex.young`
  std::string suffix;  ///< of a key that may also be written `<prefix><suffix>`
  std::vector<Declaration> children;
};

/// All keys of the study file, as a tree; with those of these laws.
Declaration study_declarations(const Laws& laws);

/// JSON Schema (draft 2020-12) of the study file, for editors; what `morula check --schema` prints.
std::string study_json_schema(const Laws& laws);
/// The reference of the study file, of its error codes and of its units, as Markdown.
std::string study_reference(const Laws& laws);
/// What a key (by full path or by its last parts, such as `dcm.cortex.tension`) or an error code (`E203`) means. Empty when neither exists;
/// laws are explained by their own registry.
std::optional<std::string> explain_study(const std::string& id, const Laws& laws);
/// Paths of keys near to a word that is no key, for "did you mean".
std::vector<std::string> study_key_paths(const Laws& laws);

}  // namespace morula::scenarios
