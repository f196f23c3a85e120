#include "results/observables/select_observables.h"

#include <algorithm>

#include "coupling/laws.h"
#include "study/diagnostics.h"

namespace morula::scenarios {

Result<std::vector<Observable>> select_observables(const Model& model, const Laws& laws, const std::vector<std::string>& names) {
  std::vector<Observable> all = observables(model, laws);
  for (auto one = all.begin(); one != all.end(); ++one)
    if (std::any_of(all.begin(), one, [&](const Observable& before) { return before.name == one->name; }))
      return Error{ErrorKind::kInput, "two observables are called '" + one->name + "'", "names of things in a study make names of columns"};
  if (names.empty()) return all;
  std::vector<Observable> out;
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Observable& o) { return o.name == name; });
    if (found == all.end())
      return Error{ErrorKind::kInput, "there is no observable '" + name + "' (output.series)",
                   suggest(name, observable_names(model, laws))};
    out.push_back(*found);
  }
  return out;
}

}  // namespace morula::scenarios
