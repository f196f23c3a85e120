// Behaviours of the registry in the study: their keys, and what they make of them.
#include <algorithm>

#include "core/numbers/joined.h"
#include "coupling/behaviours/behaviour.h"
#include "study/declare.h"
#include "study/own_section.h"

namespace morula::scenarios {
namespace {

using Shared = std::vector<std::shared_ptr<const Behaviour>>;

/// The behaviours that have a section, in the order of the registry.
Shared behaviours_of(const Laws& laws, const std::string& section) {
  Shared out;
  for (const auto& one : laws.behaviours)
    if (section == one->section.name) out.push_back(one);
  return out;
}

std::vector<std::string> sections_of(const Laws& laws) {
  std::vector<std::string> out;
  for (const auto& one : laws.behaviours)
    if (std::ranges::find(out, one->section.name) == out.end()) out.emplace_back(one->section.name);
  return out;
}

bool is_told_by_reader(const std::vector<OwnKey>& keys, const std::string& name) {
  const auto key = std::ranges::find_if(keys, [&](const OwnKey& one) { return name == one.spec.name; });
  return key->kind != OwnKey::Kind::kField && key->kind != OwnKey::Kind::kFieldValue;
}

/// `alone`: the behaviour has its section for itself.
void tell_missing(BuildContext& c, const Behaviour& what, const draft::OwnSection& own, const Place& place, bool alone) {
  auto missing = missing_keys(what.keys, own);
  if (alone) std::erase_if(missing, [&](const std::string& name) { return is_told_by_reader(what.keys, name); });
  if (!missing.empty())
    c.diagnostics.error(103, place, "`" + std::string(what.section.name) + "` needs " + listed(missing),
                        "for example `" + std::string(what.section.example) + "`");
}

/// Adds a behaviour that the study gives values; false where it says nothing of it.
bool add_behaviour(BuildContext& c, const std::shared_ptr<const Behaviour>& what, const draft::OwnSection& own, const Place& place,
                   bool alone, CellType& type) {
  if (!has_required_keys(what->keys, own)) return false;
  if (!missing_keys(what->keys, own).empty()) {
    tell_missing(c, *what, own, place, alone);
    return true;
  }
  const auto values = own_values(c, what->keys, own);
  if (!values) return true;
  if (const auto problem = what->judge != nullptr ? what->judge(*values) : std::nullopt) {
    tell_problem(c, *problem, own, place);
    return true;
  }
  type.behaviours.emplace_back(what, *values, type.name);
  return true;
}

}  // namespace

void declare_behaviour_keys(Section& s, const std::string& name, draft::CellType& t) {
  const Shared all = behaviours_of(s.laws(), name);
  std::vector<const std::vector<OwnKey>*> keys;
  for (const auto& one : all) keys.push_back(&one->keys);
  declare_own_keys(s, keys, t.behaviours[name], all.size() == 1);
}

void declare_behaviours(Section& s, const std::vector<std::string>& but, draft::CellType& t) {
  for (const std::string& name : sections_of(s.laws())) {
    if (std::ranges::find(but, name) != but.end()) continue;
    KeySpec spec = behaviours_of(s.laws(), name).front()->section;
    spec.optional_section = true;
    s.group(spec, t.behaviours[name].present, [&](Section& inner) { declare_behaviour_keys(inner, name, t); });
  }
}

void build_behaviours(BuildContext& c, const draft::CellType& draft, const Place& type_place, CellType& type) {
  for (const auto& [name, own] : draft.behaviours) {
    if (!own.present) continue;
    const Shared all = behaviours_of(*c.options.laws, name);
    std::vector<std::string> used;
    Shared idle;
    for (const auto& one : all) {
      if (!add_behaviour(c, one, own, type_place, all.size() == 1, type))
        idle.push_back(one);
      else
        for (const OwnKey& key : one->keys) used.emplace_back(key.spec.name);
    }
    if (idle.size() == all.size()) tell_missing(c, *all.front(), own, type_place, all.size() == 1);
    for (const auto& one : idle)
      for (const std::string& key : given_keys(one->keys, own))
        if (idle.size() < all.size() && std::ranges::find(used, key) == used.end())
          tell_without_effect(c, key, own, "it goes with " + listed(missing_keys(one->keys, own)));
  }
  // In the order of the registry, whatever the sections are called.
  const auto place = [&](const CellBehaviour& one) { return std::ranges::find(c.options.laws->behaviours, one.what); };
  std::ranges::stable_sort(type.behaviours, [&](const CellBehaviour& a, const CellBehaviour& b) { return place(a) < place(b); });
}

}  // namespace morula::scenarios
