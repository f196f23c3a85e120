#include "study/law_names.h"

#include <functional>
#include <set>

#include "coupling/behaviours/arrest.h"
#include "coupling/behaviours/behaviour.h"
#include "coupling/behaviours/division_axis.h"
#include "coupling/behaviours/growth_law.h"
#include "coupling/behaviours/migration_law.h"
#include "coupling/behaviours/polarity_rule.h"
#include "coupling/loads/load.h"
#include "coupling/regions/region.h"
#include "fields/reaction.h"

namespace morula::scenarios {
namespace {

/// Adds the names that come twice.
template <class Entries, class Name>
void look_through(const char* kind, const Entries& entries, const Name& name, std::vector<std::string>& out) {
  std::set<std::string> seen;
  for (const auto& entry : entries)
    if (!seen.insert(std::invoke(name, entry)).second) out.push_back(std::string(kind) + ": `" + std::invoke(name, entry) + "`");
}

}  // namespace

std::vector<std::string> names_twice(const Laws& laws) {
  std::vector<std::string> out;
  const auto word = [](const auto& entry) { return entry->word; };
  const auto name = [](const auto& entry) { return entry->info.name; };
  look_through(
      "laws of shells", laws.shells, [](const dcm::ShellLaw& law) { return law.info.name; }, out);
  look_through("contact of spheres", laws.spheres, word, out);
  look_through("contact of surfaces", laws.surfaces, word, out);
  look_through("behaviours", laws.behaviours, name, out);
  look_through("growth", laws.growth, word, out);
  look_through("arrest", laws.arrest, name, out);
  look_through("axes of division", laws.division_axes, name, out);
  look_through("migration", laws.migration, name, out);
  look_through("polarity", laws.polarity, name, out);
  look_through("loads", laws.loads, name, out);
  look_through("shapes of regions", laws.region_shapes, name, out);
  look_through("values of triggers", laws.trigger_values, name, out);
  look_through("reactions", laws.reactions, name, out);
  return out;
}

}  // namespace morula::scenarios
