#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "study/build.h"
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

void check_keys(BuildContext& c, const draft::ContactPair& pair, const Place& place) {
  const bool elastic = pair.law.value == "maugis_dugdale";
  if (elastic && !pair.reduced_modulus.given)
    c.diagnostics.error(516, place, "law maugis_dugdale needs the modulus of the bodies in contact", "add for example `modulus: 500 Pa`");
  if (!elastic && pair.reduced_modulus.given)
    c.diagnostics.error(515, pair.reduced_modulus.place, "`modulus` belongs to law maugis_dugdale, but the law is " + pair.law.value,
                        "remove it, or write `law: maugis_dugdale`");
  if (elastic && pair.repulsion.given)
    c.diagnostics.error(515, pair.repulsion.place, "law maugis_dugdale has its repulsion from `modulus`", "remove `repulsion`");
  const Given<double>& shortest = c.draft.contact.range;
  if (pair.range.given && pair.range.known() && shortest.known() && pair.range.value < shortest.value)
    c.diagnostics.error(510, pair.range.place,
                        "the range of this pair (" + pair.range.text + ") is below `contact.range` (" + shortest.text + ")",
                        "give the shortest range as `contact.range`, and longer ones by pair: steps are measured by the shortest");
}

/// Contact bears the pressure of a cell, p = 2 tension/R: an elastic repulsion gives way by (π √R p/E*)² (decision 0018).
void check_depth(BuildContext& c, const draft::ContactPair& pair, const Materials& materials) {
  if (pair.law.value != "maugis_dugdale" || !pair.reduced_modulus.known() || !c.draft.limits.overlap.known()) return;
  double curvature = 0.0, pressure = 0.0;
  for (const std::size_t m : {materials.a, materials.b}) {
    if (m >= c.draft.cell_types.size()) continue;
    const draft::CellType& type = c.draft.cell_types[m].content;
    if (!type.radius.mean.known() || !type.tension.known()) return;
    curvature += 1.0 / type.radius.mean.value;
    pressure = std::max(pressure, 2.0 * type.tension.value / type.radius.mean.value);
  }
  const double allowed = c.draft.limits.overlap.value, least = std::numbers::pi * pressure / std::sqrt(curvature * allowed);
  if (pair.reduced_modulus.value >= least) return;
  const double depth = std::pow(std::numbers::pi * pressure / pair.reduced_modulus.value, 2) / curvature;
  c.diagnostics.warning(517, pair.reduced_modulus.place,
                        "cells under their own pressure sink into each other by about " + short_number(std::round(depth * 100.0) / 100.0) +
                            " um: modulus " + pair.reduced_modulus.text + " is that of soft bodies",
                        "at least " + short_number(std::ceil(least * 10.0) / 10.0) + " kPa keeps the overlap below `limits.overlap` (" +
                            c.draft.limits.overlap.text + ")");
}

}  // namespace

void build_contact_pairs(BuildContext& c) {
  const std::size_t count = c.draft.cell_types.size() + c.draft.geometry.size();
  std::vector<const Place*> seen(count * count, nullptr);
  for (const auto& [name, place, d] : c.draft.contact.pairs) {
    check_keys(c, d, place);
    const auto found = materials_of(c, d.between);
    if (!found) continue;
    const auto [a, b] = *found;
    check_depth(c, d, *found);
    const std::size_t slot = std::min(a, b) * count + std::max(a, b);
    if (seen[slot] != nullptr) {
      c.diagnostics.error(510, place, "this pair stands here for the second time, after line " + std::to_string(seen[slot]->line),
                          "give each pair once");
      continue;
    }
    seen[slot] = &place;
    ContactPair& pair = c.study.model.pairs[a * count + b];
    pair.law = d.law.value == "maugis_dugdale" ? SurfaceLaw::kMaugisDugdale
               : d.law.value == "falling"      ? SurfaceLaw::kFalling
                                               : SurfaceLaw::kTent;
    if (d.range.given) pair.range = d.range.value;
    if (d.repulsion.given) pair.repulsion = d.repulsion.value;
    if (d.reduced_modulus.given) pair.reduced_modulus = d.reduced_modulus.value;
    if (d.normal_friction.given) pair.normal_friction = d.normal_friction.value;
    if (d.tangential_friction.given) pair.tangential_friction = d.tangential_friction.value;
    c.study.model.pairs[b * count + a] = pair;
  }
}

}  // namespace morula::scenarios
