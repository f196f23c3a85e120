#pragma once
#include <string>
#include <vector>

#include "core/law_info.h"
#include "coupling/laws.h"

namespace morula::app {

/// A law with the part of the program that it belongs to: "contact of spheres", "shells", "behaviours".
struct ListedLaw {
  std::string group;
  LawInfo info;
};

/// All laws that a program with these has, in the order of the documentation.
std::vector<ListedLaw> all_laws(const Laws& laws);
/// The law of this name, or an empty list; a name may stand in several groups.
std::vector<ListedLaw> laws_named(const Laws& laws, const std::string& name);
/// Names for "did you mean".
std::vector<std::string> law_names(const Laws& laws);

/// A law for a person at a terminal: title, equation, source, parameters.
[[nodiscard]] std::string law_text(const ListedLaw& law);
/// The same as JSON.
[[nodiscard]] std::string law_json(const ListedLaw& law);
/// The reference of all laws as Markdown.
[[nodiscard]] std::string law_reference(const Laws& laws);

}  // namespace morula::app
