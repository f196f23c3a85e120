#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "study/build.h"
#include "study/law_keys.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

/// Number of a cell type or obstacle, or nothing and an error with suggestions.
std::optional<std::size_t> find_material(BuildContext& c, const std::string& name, const Place& place) {
  std::vector<std::string> names;
  for (const auto& type : c.draft.cell_types) names.push_back(type.name);
  for (const auto& obstacle : c.draft.geometry) names.push_back(obstacle.name);
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  c.diagnostics.error(401, place, "there is no cell type or obstacle '" + name + "'", suggest(name, names));
  return std::nullopt;
}

struct Materials {
  std::size_t a, b;
};

std::optional<Materials> materials_of(BuildContext& c, const Given<std::vector<std::string>>& between) {
  if (!between.known()) return std::nullopt;
  const auto& names = between.value;
  if (names.empty() || names.size() > 2) {
    c.diagnostics.error(510, between.place, "`between` names " + std::to_string(names.size()) + " materials", "name two, or one alone");
    return std::nullopt;
  }
  const auto a = find_material(c, names.front(), between.place), b = find_material(c, names.back(), between.place);
  if (!a || !b) return std::nullopt;
  if (std::min(*a, *b) >= c.draft.cell_types.size()) {
    c.diagnostics.error(510, between.place, "obstacles have no contact with obstacles", "name a cell type");
    return std::nullopt;
  }
  return Materials{*a, *b};
}

std::shared_ptr<const SurfaceLaw> law_of(const BuildContext& c, const draft::ContactPair& pair) {
  for (const auto& law : c.options.laws->surfaces)
    if (law->word == pair.law.value) return law;
  return tent_law();  // told
}

/// Keys of the laws' own: E515 where another law stands, E516 where one is missing.
void check_own_keys(BuildContext& c, const draft::ContactPair& pair, const SurfaceLaw& law, const Place& place) {
  for (const auto& [name, key] : pair.own) {
    const LawKeyUse use = use_of(name, key, choosable_surface_laws(*c.options.laws), law.word);
    std::string owners;
    for (const std::string& word : use.owners) owners += (owners.empty() ? "" : " or ") + word;
    if (use.has_effect && !key.known() && !key.given)
      c.diagnostics.error(516, place, "law " + law.word + " needs `" + name + "`", "add for example `" + name + ": " + use.example + "`");
    if (use.in_vain)
      c.diagnostics.error(515, key.place, "`" + name + "` belongs to law " + owners + ", but the law is " + pair.law.value,
                          "remove it, or write `law: " + owners + "`");
  }
}

void check_keys(BuildContext& c, const draft::ContactPair& pair, const SurfaceLaw& law, const Place& place) {
  check_own_keys(c, pair, law, place);
  if (!law.has_repulsion && pair.repulsion.given)
    c.diagnostics.error(515, pair.repulsion.place, "law " + law.word + " has a repulsion of its own", "remove `repulsion`");
  const Given<double>& shortest = c.draft.contact.range;
  if (pair.range.given && pair.range.known() && shortest.known() && pair.range.value < shortest.value)
    c.diagnostics.error(510, pair.range.place,
                        "the range of this pair (" + pair.range.text + ") is below `contact.range` (" + shortest.text + ")",
                        "give the shortest range as `contact.range`, and longer ones by pair: steps are measured by the shortest");
}

/// W515 for what a pair says of surfaces where spheres meet, or a sphere an obstacle: they have laws of their own (`cbm`), and of a pair its friction.
void check_surfaces(BuildContext& c, const draft::ContactPair& pair, const Materials& materials) {
  const std::size_t types = c.draft.cell_types.size();
  for (const std::size_t m : {materials.a, materials.b})
    if (m < types && may_be_shell(c, m)) return;
  const auto warn = [&](const Place& place, const std::string& key) {
    c.diagnostics.warning(515, place, "`" + key + "` is of surfaces, and these cells are always spheres: it has no effect",
                          "remove it, or give one of the types `body: shell`; the contact of spheres is that of `cbm`");
  };
  if (pair.law.given) warn(pair.law.place, "law");
  if (pair.range.given) warn(pair.range.place, "range");
  if (pair.repulsion.given) warn(pair.repulsion.place, "repulsion");
  if (!pair.regions.empty()) warn(pair.regions.front().place, "regions");
}

/// What the law says of its values, knowing the pressure 2 tension/R that a contact of these cells bears.
void judge_values(BuildContext& c, const draft::ContactPair& pair, const SurfaceLaw& law, const Materials& materials) {
  if (law.judge == nullptr || !c.draft.limits.overlap.known()) return;
  LawValues values;
  for (const KeySpec& key : law.own) {
    if (!pair.own.at(key.name).known()) return;
    values.set(key.name, pair.own.at(key.name).value);
  }
  double curvature = 0.0, pressure = 0.0;
  for (const std::size_t m : {materials.a, materials.b}) {
    if (m >= c.draft.cell_types.size()) continue;
    const draft::CellType& type = c.draft.cell_types[m].content;
    if (!type.radius.mean.known() || !type.tension.known()) return;
    curvature += 1.0 / type.radius.mean.value;
    pressure = std::max(pressure, 2.0 * type.tension.value / type.radius.mean.value);
  }
  values.set("curvature", curvature), values.set("pressure", pressure), values.set("overlap", c.draft.limits.overlap.value);
  const auto problem = law.judge(values);
  if (!problem) return;
  const Given<double>& key = pair.own.at(problem->key);
  std::string what = problem->what;
  if (const std::size_t gap = what.find("{}"); gap != std::string::npos) what.replace(gap, 2, key.text);
  c.diagnostics.warning(problem->code, key.place, what, problem->help + " (" + c.draft.limits.overlap.text + ")");
}

}  // namespace

void build_contact_pairs(BuildContext& c) {
  const Given<std::string>& friction = c.draft.contact.friction;
  if (friction.given && friction.value == "objective" && !may_have_shells(c))
    c.diagnostics.warning(515, friction.place, "`friction: objective` is of surfaces, and all cells are always spheres: it has no effect",
                          "remove it: spheres do not turn");
  const std::size_t count = c.draft.cell_types.size() + c.draft.geometry.size();
  std::vector<const Place*> seen(count * count, nullptr);
  for (const auto& [name, place, d] : c.draft.contact.pairs) {
    const std::shared_ptr<const SurfaceLaw> law = law_of(c, d);
    check_keys(c, d, *law, place);
    const auto found = materials_of(c, d.between);
    if (!found) continue;
    const auto [a, b] = *found;
    check_surfaces(c, d, *found);
    judge_values(c, d, *law, *found);
    const std::size_t slot = std::min(a, b) * count + std::max(a, b);
    if (seen[slot] != nullptr) {
      c.diagnostics.error(510, place, "this pair stands here for the second time, after line " + std::to_string(seen[slot]->line),
                          "give each pair once");
      continue;
    }
    seen[slot] = &place;
    ContactPair& pair = c.study.model.pairs[a * count + b];
    pair.law = law;
    if (d.range.given) pair.range = d.range.value;
    if (d.repulsion.given) pair.repulsion = d.repulsion.value;
    for (const KeySpec& key : law->own)
      if (const auto at = d.own.find(key.name); at != d.own.end() && at->second.known()) pair.own.set(key.name, at->second.value);
    if (d.normal_friction.given) pair.normal_friction = d.normal_friction.value;
    if (d.tangential_friction.given) pair.tangential_friction = d.tangential_friction.value;
    c.study.model.pairs[b * count + a] = pair;
  }
}

double usual_repulsion(const draft::Study& study) {
  constexpr double kUsual = 100.0;  // [kPa/µm]
  const double given = study.contact.repulsion.value;
  return given > 0.0 ? given : kUsual;
}

void build_repulsion(BuildContext& c) {
  constexpr double kOverAdhesion = 60.0;  // k_r c²/W, below which a wedge that adhesion draws in comes deep (decision 0095)
  if (c.draft.contact.repulsion.value > 0.0) return;
  Model& model = c.study.model;
  const std::size_t count = model.material_count();
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b) {
      ContactPair& pair = model.pairs[a * count + b];
      if (pair.repulsion > 0.0 || !pair.law->has_repulsion) continue;
      double adhesion = pair.adhesion;
      for (const AdhesionRule& rule : pair.regions) adhesion = std::max(adhesion, rule.adhesion);
      if (a == b && a < model.types.size())
        if (const CellType& type = model.types[a]; type.cycles && type.shells_divide && type.new_surface > 0.0 && may_be_shell(c, a))
          adhesion = std::max(adhesion, 2.0 * type.shell.tension);
      const double range = pair.range > 0.0 ? pair.range : model.contact.range, least = kOverAdhesion * adhesion / (range * range);
      if (least > model.contact.repulsion) pair.repulsion = least;
    }
}

}  // namespace morula::scenarios
