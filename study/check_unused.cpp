// What the study says and nothing in it reads.
#include <algorithm>
#include <ranges>
#include <set>
#include <tuple>

#include "study/build.h"
#include "study/declare.h"
#include "study/given_keys.h"

namespace morula::scenarios {
namespace {

void tell(BuildContext& c, const Place& place, const std::string& what, const std::string& help) {
  c.diagnostics.warning(515, place, what + ": it has no effect", help);
}

/// Keys of shells in a type that nobody made one, and that no fitted law is of. Who writes `body` or `as: sphere` beside them knows; a type that is like another has its keys.
void check_shells_that_are_none(BuildContext& c) {
  using Spot = std::tuple<const SourceText*, int, int>;
  const auto spot = [](const Place& place) { return Spot{place.source.get(), place.line, place.column}; };
  const auto keys = [&c](draft::CellType& type) {
    auto out = keys_written_in(*c.options.laws, [&type](Section& s) { declare_shell(s, type); });
    std::erase_if(out, [](const GivenKey& key) { return key.path == "bulk_modulus"; });  // modulus and packing of spheres follow from it
    for (GivenKey& key : out) key.path.insert(0, "dcm.");
    if (type.shells_divide.is_changed()) out.push_back({"cycle.shells", type.shells_divide.place});
    if (type.new_surface.is_changed()) out.push_back({"cycle.new_surface", type.new_surface.place});
    return out;
  };
  const bool has_meshes = std::ranges::any_of(c.draft.initial, [](const auto& block) { return block.content.has_meshes; });
  if (has_meshes || !c.options.fitted_laws) return;  // cells of meshes are shells; a type that is being fitted is looked at as both bodies
  std::set<Spot> used;
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i)
    if (may_be_shell(c, i) || c.draft.cell_types[i].content.sphere_law.value == kFittedLaw)
      for (const GivenKey& key : keys(c.draft.cell_types[i].content)) used.insert(spot(key.place));
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i) {
    auto& [name, place, type] = c.draft.cell_types[i];
    if (type.body.given || may_be_shell(c, i) || std::ranges::any_of(c.draft.initial, [](const auto& b) { return b.content.body.given; }))
      continue;
    auto given = keys(type);
    std::erase_if(given, [&](const GivenKey& key) { return used.contains(spot(key.place)); });
    if (given.empty()) continue;
    const std::string others = given.size() > 1 ? " (and " + std::to_string(given.size() - 1) + " more)" : "";
    tell(c, given.front().place, "`" + given.front().path + "`" + others + " is of shells, and cells of '" + name + "' are always spheres",
         "`body: shell`, or a rule of `coupling`; `body: sphere` where it is meant so");
    for (const GivenKey& key : given) used.insert(spot(key.place));  // types that are like this one say nothing more
  }
}

/// What holds growth back, and the age of cells, where nobody grows. Who writes a cycle of `model: none` knows.
void check_rest(BuildContext& c) {
  const std::size_t types = c.draft.cell_types.size();
  for (const auto& [name, place, type] : c.draft.cell_types)
    if (!type.has_cycle && type.pressure_above.is_changed())
      tell(c, type.pressure_above.place, "'inhibit_growth' is of cells that grow, and those of '" + name + "' have no cycle",
           "give them a `cycle`");
  for (std::size_t k = 0; k < c.study.initial.size(); ++k) {
    const InitialCells& cells = c.study.initial[k];
    const auto grows_among_them = [&](std::size_t i) { return c.draft.cell_types[i].content.has_cycle && cells.may_have(i); };
    const Given<std::string>& age = c.draft.initial[k].content.age;
    if (age.is_changed() && std::ranges::none_of(std::views::iota(std::size_t{0}, types), grows_among_them))
      tell(c, age.place, "'age' is of cells with a cycle, and none of these has one", "give them a `cycle`");
  }
}

/// What belongs to rules of exchange, where there is none.
void check_exchange(BuildContext& c) {
  draft::Coupling& d = c.draft.coupling;
  const Given<double>& hold = d.swaps.of("hold", &Swaps::hold);
  const Swaps& swaps = c.study.model.swaps;
  if (swaps.regions.empty() && !swaps.triggers.empty() && hold.is_changed())
    tell(c, hold.place, "'hold' of `coupling` is of regions, and there is none", "`hold` of each trigger");
  if (swaps.any()) return;
  const Given<std::uint64_t>& most = d.swaps.of("max_shells", &Swaps::max_shells);
  const auto warn = [&c](const Place& place, const char* key) {
    tell(c, place, std::string("'") + key + "' is of rules by which cells change their body, and there is none",
         "add `regions` or `triggers`");
  };
  if (hold.is_changed()) warn(hold.place, "hold");
  if (most.is_changed()) warn(most.place, "max_shells");
}

/// What the contacts of surfaces have, where there are none.
void check_contact(BuildContext& c) {
  if (may_have_shells(c)) return;
  const draft::Contact& d = c.draft.contact;
  const auto warn = [&c](const Place& place, const char* key) {
    tell(c, place, std::string("'") + key + "' is of surfaces, and all cells are always spheres",
         "the contact of spheres is that of `cbm`");
  };
  if (d.points.is_changed()) warn(d.points.place, "points");
  if (d.repulsion.is_changed()) warn(d.repulsion.place, "repulsion");
}

/// Adhesion of cells that are always spheres, by laws of contact that have none.
void check_adhesion_of_spheres(BuildContext& c) {
  const std::vector<CellType>& types = c.study.model.types;
  const auto adheres = [](const CellType& type) {
    const cbm::SphereLaw& law = *type.sphere.law;
    return law.couple == nullptr || law.couple(type.sphere, nullptr, 0.0) != law.couple(type.sphere, nullptr, 1.0);
  };
  const auto has_file = [](const auto& type) { return type.content.sphere_law.value == kFittedLaw; };  // which says what it was fitted with
  if (types.size() != c.draft.cell_types.size() || may_have_shells(c) || std::ranges::any_of(types, adheres) ||
      std::ranges::any_of(c.draft.cell_types, has_file))
    return;
  for (const auto& [name, place, type] : c.draft.cell_types)
    for (const auto& [other, at, energy] : type.adhesion)
      if (energy.given && energy.value > 0.0)
        return tell(c, energy.place,
                    "'adhesion' is of contacts that adhere, and all cells are spheres with `law: " + type.sphere_law.value + "`",
                    "`cbm: {law: jkr}`");
}

/// What spheres have with shells, and cells with obstacles, where there are none.
void check_partners(BuildContext& c) {
  const bool shells = may_have_shells(c) || !c.options.fitted_laws, obstacles = !c.study.model.obstacles.empty();
  for (auto& [name, place, type] : c.draft.cell_types) {
    const auto warn = [&c](const Given<double>& key, bool has, const char* word, const char* whom) {
      if (key.is_changed() && !has)
        tell(c, key.place, std::string("'") + word + "' is of contacts with " + whom + ", and there are none", "leave it away");
    };
    if (type.sphere_law.value != kFittedLaw) {  // else they are those of its file
      warn(type.with_shells.of("stiffness", &cbm::WithShells::stiffness), shells, "with_shells.stiffness", "shells");
      warn(type.with_shells.of("adhesion", &cbm::WithShells::adhesion), shells, "with_shells.adhesion", "shells");
    }
    warn(type.tangential_obstacle, obstacles, "obstacle_tangential", "obstacles");
  }
}

/// A run whose cells are driven never comes to rest.
void check_end_at_rest(BuildContext& c) {
  const Given<double>& rest = c.draft.time.rest;
  if (!rest.is_changed() || !(rest.value > 0.0)) return;
  for (std::size_t i = 0; i < c.study.model.types.size(); ++i) {
    const CellType& type = c.study.model.types[i];
    const char* what = type.migration.acts() ? "crawl" : type.fluctuations.energy > 0.0 ? "fluctuate" : nullptr;
    if (what == nullptr || std::ranges::none_of(c.study.initial, [i](const InitialCells& cells) { return cells.may_have(i); })) continue;
    return tell(c, rest.place, "the run never comes to rest, for cells of '" + type.name + "' " + what, "leave `rest` away");
  }
}

void check_marks(BuildContext& c) {
  for (auto& [name, place, mark] : c.draft.marks)
    if (mark.touched && mark.when.given && mark.when.value == "start")
      tell(c, mark.when.place, "mark '" + name + "' is of what touches, which is looked at in every step, whatever 'when' says",
           "`when: always`; `touched_by: {keep: true}` keeps what was touched once");
  for (auto& [name, place, lumen] : c.draft.lumens) {
    if (lumen.faces.value == "seen") continue;
    const auto warn = [&](const Given<double>& key, const char* word) {
      if (key.is_changed())
        tell(c, key.place, std::string("'") + word + "' is of what is seen, and the cavity '" + name + "' has the faces of a mark",
             "leave it away, or `faces: seen`");
    };
    warn(lumen.plain.of("reach", &Lumen::reach), "reach");
    warn(lumen.plain.of("renewed", &Lumen::renewed), "renewed");
  }
}

}  // namespace

void check_unused(BuildContext& c) {
  check_shells_that_are_none(c);
  check_rest(c);
  check_end_at_rest(c);
  check_exchange(c);
  check_contact(c);
  check_adhesion_of_spheres(c);
  check_partners(c);
  check_marks(c);
}

}  // namespace morula::scenarios
