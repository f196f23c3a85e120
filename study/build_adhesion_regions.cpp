// Adhesion by part of the surface (`contact.pairs: regions`).
#include <algorithm>
#include <optional>

#include "study/build.h"
#include "study/read_section.h"

namespace morula::scenarios {

bool may_carry_mark(const BuildContext& c, int material, int mark) {
  const Model& model = c.study.model;
  if (material >= static_cast<int>(model.types.size()) || !may_be_shell(c, static_cast<std::size_t>(material))) return false;
  for (const FaceMark& rule : model.marks)
    if (rule.mark == mark && rule.type == material) return true;
  return std::any_of(model.lumens.begin(), model.lumens.end(), [mark](const Lumen& l) { return l.mark == mark && l.by_sight; });
}

namespace {

constexpr int kAnyFace = -1;

/// Number of the mark that `name` stands for, or kAnyFace; nothing and an error where no face can carry it.
std::optional<int> mark_of(BuildContext& c, int material, const std::string& name, const Place& place) {
  if (name == "any") return kAnyFace;
  const int mark = find_mark(c, name, place);
  if (mark < 0) return std::nullopt;
  if (may_carry_mark(c, material, mark)) return mark;
  const std::size_t types = c.draft.cell_types.size(), number = static_cast<std::size_t>(material);
  const std::string& owner = number < types ? c.draft.cell_types[number].name : c.draft.geometry[number - types].name;
  c.diagnostics.error(580, place, "no face of '" + owner + "' ever carries the mark '" + name + "'",
                      number < types ? "give the mark to shells of this type (`marks: " + name + ": types`), or write `any`"
                                     : "write `any` for an obstacle");
  return std::nullopt;
}

/// Tension of the faces of a type with this mark, and whether something elastic holds them.
struct Hold {
  double tension;
  bool elastic;
};
Hold hold_of(const BuildContext& c, std::size_t type, int mark) {
  const draft::CellType& t = c.draft.cell_types[type].content;
  Hold out{t.tension.value, resists_in_plane(t)};
  for (const TensionRegion& region : c.study.model.types[type].regional_tension.regions)
    if (region.mark >= 0 && region.mark == mark) return {region.tension, out.elastic};
  return out;
}

/// As E509 is for whole surfaces: W against the tensions of both faces (of one, twice, at an obstacle).
void check_strength(BuildContext& c, const Given<double>& w, int a, int b, int mark_a, int mark_b) {
  const int types = static_cast<int>(c.draft.cell_types.size());
  if (!w.known() || w.value == 0.0) return;
  if (a >= types) return check_strength(c, w, b, a, mark_b, mark_a);
  const Hold one = hold_of(c, static_cast<std::size_t>(a), mark_a);
  const Hold other = b < types ? hold_of(c, static_cast<std::size_t>(b), mark_b) : one;
  if (w.value < one.tension + other.tension) return;
  const std::string what = "faces of this region adhere by " + w.text + ", not less than both tensions together (" +
                           short_number(one.tension + other.tension) + " mN/m): ";
  const std::string help = "more tension there, or less adhesion";
  if (!one.elastic || !other.elastic)
    c.diagnostics.error(581, w.place, what + "a cortex that is not elastic spreads without end", help);
  else
    c.diagnostics.warning(581, w.place, what + "only the elasticity of the cortex stops the spreading", help);
}

void build_rule(BuildContext& c, int a, int b, const draft::AdhesionRegion& region) {
  if (!region.faces.known()) return;
  const auto& names = region.faces.value;
  if (names.empty() || names.size() > 2) {
    c.diagnostics.error(580, region.faces.place, "`faces` names " + std::to_string(names.size()) + " marks",
                        "one for each of the two materials, or `any`");
    return;
  }
  const std::optional<int> first_mark = mark_of(c, a, names.front(), region.faces.place);
  const std::optional<int> second_mark = names.size() == 2 ? mark_of(c, b, names.back(), region.faces.place) : kAnyFace;
  if (!first_mark || !second_mark) return;
  const int first = *first_mark, second = *second_mark;
  if (first == kAnyFace && second == kAnyFace) {
    c.diagnostics.error(580, region.faces.place, "`faces` of a region names no mark: it would hold everywhere",
                        "name a mark, or give the adhesion of the pair with the cell types");
    return;
  }
  check_strength(c, region.adhesion, a, b, first, second);
  Model& model = c.study.model;
  const auto add = [&](int of, int with, int mark_of_one, int mark_of_other) {
    model.pairs[static_cast<std::size_t>(of) * model.material_count() + static_cast<std::size_t>(with)].regions.push_back(
        {mark_of_one, mark_of_other, region.adhesion.value});
  };
  add(a, b, first, second);
  if (a != b || first != second) add(b, a, second, first);
}

}  // namespace

void build_adhesion_regions(BuildContext& c) {
  const std::size_t materials = c.draft.cell_types.size() + c.draft.geometry.size();
  if (c.study.model.pairs.size() != materials * materials || c.study.model.material_count() != materials) return;
  for (const auto& [name, place, pair] : c.draft.contact.pairs) {
    if (pair.regions.empty() || !pair.between.known() || pair.between.value.empty() || pair.between.value.size() > 2) continue;
    const auto number = [&](const std::string& material) {
      for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i)
        if (c.draft.cell_types[i].name == material) return static_cast<int>(i);
      for (std::size_t i = 0; i < c.draft.geometry.size(); ++i)
        if (c.draft.geometry[i].name == material) return static_cast<int>(c.draft.cell_types.size() + i);
      return -1;  // E401 has been told
    };
    const int a = number(pair.between.value.front()), b = number(pair.between.value.back());
    if (a < 0 || b < 0) continue;
    for (const auto& region : pair.regions) build_rule(c, a, b, region.content);
  }
}

}  // namespace morula::scenarios
