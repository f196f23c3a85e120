#include "study/law_faults.h"

#include <set>
#include <utility>

#include "coupling/behaviours/arrest.h"
#include "coupling/behaviours/behaviour.h"
#include "coupling/behaviours/division_axis.h"
#include "coupling/behaviours/growth_law.h"
#include "coupling/behaviours/migration_law.h"
#include "coupling/behaviours/polarity_rule.h"
#include "coupling/loads/load.h"
#include "coupling/observables/observable.h"
#include "coupling/regions/region.h"
#include "fields/reaction.h"

namespace morula::scenarios {
namespace {

/// Functions that a law must have: how they are called in its struct, and whether they are there.
using Needs = std::vector<std::pair<const char*, bool>>;

std::string quoted(const std::string& name) { return "`" + name + "`"; }

/// Looks through the laws of one kind, of which `name` tells the name and `needs` what each must have.
template <class Entries, class Name, class NeedsOf>
void look_through(const char* kind, const Entries& entries, const Name& name, const NeedsOf& needs, std::vector<std::string>& out) {
  std::set<std::string> seen;
  for (const auto& entry : entries) {
    if (entry == nullptr) {
      out.push_back("one of " + quoted(kind) + " is a null pointer");
      continue;
    }
    const std::string called = name(entry);
    if (!seen.insert(called).second) out.push_back("two of " + quoted(kind) + " are called " + quoted(called));
    for (const auto& [function, there] : Needs(needs(*entry)))
      if (!there) out.push_back(quoted(called) + " of " + quoted(kind) + " has no " + quoted(function));
  }
}

Needs needs_of_load(const Load& load) {
  const int ways =
      int{load.push != nullptr} + int{load.push_cell != nullptr} + int{load.hold != nullptr} + int{load.hold_center != nullptr};
  return {{"force: push, push_cell, hold or hold_center, just one of them", ways == 1}};
}

Needs needs_of_reaction(const fields::Reaction& one) {
  if (one.where == fields::Reaction::Where::kCells)
    return {{"coefficients", one.coefficients != nullptr},
            {"taken", one.taken != nullptr},
            {"steepest", one.steepest != nullptr},
            {"add_rates_of_cells", one.add_rates_of_cells != nullptr},
            {"add_slopes_of_cells", one.add_slopes_of_cells != nullptr}};
  return {{"coefficients", one.coefficients != nullptr},
          {"taken", one.taken != nullptr},
          {"slope", !one.first_order || one.slope != nullptr},
          {"steepest", one.first_order || one.steepest != nullptr},
          {"add_rates", one.first_order || one.add_rates != nullptr},
          {"add_slopes", one.first_order || one.add_slopes != nullptr}};
}

/// Of laws without null pointers.
void look_through_observables(const Laws& laws, std::vector<std::string>& out) {
  const auto breaks_a_header = [](const std::string& text, const char* also) {
    return text.find_first_of(",\"\r\n") != std::string::npos || text.find_first_of(also) != std::string::npos;
  };
  std::set<std::string> seen;
  for (const Observable& one : observables_of_any_model(laws)) {
    if (one.name.empty() || breaks_a_header(one.name, "[]") || breaks_a_header(one.unit, "[]"))
      out.push_back("no column of series.csv can be called `" + one.name + " [" + one.unit + "]`, as one of `observables` is");
    if (!seen.insert(one.name).second) out.push_back("two of `observables` are called " + quoted(one.name));
    if (!one.value) out.push_back(quoted(one.name) + " of `observables` has no `value`");
  }
}

}  // namespace

std::vector<std::string> law_faults(const Laws& laws) {
  std::vector<std::string> out;
  const auto word = [](const auto& entry) { return entry->word; };
  const auto name = [](const auto& entry) { return entry->info.name; };
  const auto nothing = [](const auto&) { return Needs{}; };
  const auto builds = [](const auto& one) { return Needs{{"build", one.build != nullptr}}; };
  std::set<std::string> shells;
  for (const dcm::ShellLaw& law : laws.shells)
    if (!shells.insert(law.info.name).second) out.push_back("two of `laws of shells` are called " + quoted(law.info.name));
  look_through(
      "contact of spheres", laws.spheres, word,
      [](const cbm::SphereLaw& one) {
        return Needs{{"couple", one.couple != nullptr}, {"evaluate", one.evaluate != nullptr}, {"respond", one.respond != nullptr}};
      },
      out);
  look_through("contact of surfaces", laws.surfaces, word, builds, out);
  look_through("behaviours", laws.behaviours, name, builds, out);
  look_through(
      "growth", laws.growth, word,
      [](const GrowthLaw& one) {
        return Needs{{"at", one.at != nullptr}, {"after", one.after != nullptr}, {"time_to", one.time_to != nullptr}};
      },
      out);
  look_through("arrest", laws.arrest, name, builds, out);
  look_through(
      "axes of division", laws.division_axes, name,
      [](const DivisionAxis& one) {
        return Needs{{"of", one.of != nullptr}};
      },
      out);
  look_through(
      "migration", laws.migration, name,
      [](const MigrationLaw& one) {
        return Needs{{"at_birth", one.at_birth != nullptr}, {"step", one.step != nullptr}};
      },
      out);
  look_through(
      "polarity", laws.polarity, name,
      [](const PolarityRule& one) {
        return Needs{{"acts", one.acts != nullptr}, {"turn", one.turn != nullptr}};
      },
      out);
  look_through("loads", laws.loads, name, needs_of_load, out);
  look_through("shapes of regions", laws.region_shapes, name, nothing, out);
  look_through(
      "values of triggers", laws.trigger_values, name,
      [](const TriggerValue& one) {
        return Needs{{"of", one.of != nullptr}};
      },
      out);
  look_through("reactions", laws.reactions, name, needs_of_reaction, out);
  for (const Observables& family : laws.observables)
    if (!family) out.push_back("one of `observables` is empty");
  if (out.empty()) look_through_observables(laws, out);
  return out;
}

}  // namespace morula::scenarios
