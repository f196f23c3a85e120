#include "coupling/cell_variables.h"

#include <algorithm>
#include <utility>

namespace morula {

namespace {

bool any_varies(const Model& model, Trait trait) {
  return std::ranges::any_of(model.types, [trait](const CellType& type) { return type.traits.vary_in(trait); });
}
std::string name_of(Trait trait) { return std::string(kTraitNames[number_of(trait)]) + "/deviation"; }

bool has_phases(const Model& model) {
  return std::ranges::any_of(model.types, [](const CellType& type) { return !type.cycle.phases.empty(); });
}

}  // namespace

std::size_t mesh_renewal_variable(const Model& model, MeshRenewal which) {
  return cycle_variables_of(model.fields.size()) + (has_phases(model) ? 3 : 0) + static_cast<std::size_t>(which);
}

std::size_t own_mesh_variable(const Model& model, OwnMeshRenewal which) {
  return mesh_renewal_variable(model, MeshRenewal::kDone) + kMeshRenewals + static_cast<std::size_t>(which);
}

std::vector<CellVariable> cell_variables(const Model& model) {
  std::vector<CellVariable> out;
  for (const fields::FieldSpec& field : model.fields) {
    out.push_back({"amount/" + field.name, "amol", AtDivision::kShared});
    out.push_back({"concentration/" + field.name, "mM", AtDivision::kCopied});
  }
  if (has_phases(model))
    for (const auto& [name, unit] : {std::pair(kPhaseVariable, "1"), {"cycle/left", "s"}, {"cycle/held", "s"}})
      out.push_back({name, unit, AtDivision::kSet, true});
  if (std::ranges::any_of(model.types, [](const CellType& type) { return type.renew_mesh_below > 0.0; }))
    for (const auto& [name, unit] : {std::pair("done", "1"), {"refused", "1"}, {"next_try", "s"}, {"area_change", "1"}, {"distance", "1"}})
      out.push_back({std::string("mesh_renewal/") + name, unit, AtDivision::kUsual});
  if (std::ranges::any_of(model.types, [](const CellType& type) { return type.own_mesh; }))
    for (const auto& [name, unit] : {std::pair("passes", "1"),
                                     {"changes", "1"},
                                     {"skipped", "1"},
                                     {"returns", "1"},
                                     {"next_pass", "s"},
                                     {"area_change", "1"},
                                     {"volume_change", "1"},
                                     {"off_surface", "1"}})
      out.push_back({std::string("own_mesh/") + name, unit, AtDivision::kUsual});
  for (const CellType& type : model.types)
    for (const CellBehaviour& behaviour : type.behaviours)
      for (const BehaviourVariable& variable : behaviour.what->variables) {
        const CellVariable one{behaviour.what->info.name + "/" + variable.name, variable.unit,
                               variable.shared ? AtDivision::kShared : AtDivision::kCopied, true};
        if (std::ranges::find(out, one) == out.end()) out.push_back(one);
      }
  for (const Trait trait : kTraits)
    if (any_varies(model, trait)) out.push_back({name_of(trait), "1", AtDivision::kSet});
  for (const Lumen& lumen : model.lumens)
    if (lumen.by_sight)
      for (const char* axis : {"/x", "/y", "/z"}) out.push_back({"cavity/" + lumen.name + axis, "um^2", AtDivision::kUsual});
  return out;
}

std::size_t cavity_variables(const Model& model, std::size_t lumen) {
  const std::vector<CellVariable> all = cell_variables(model);
  return static_cast<std::size_t>(std::ranges::find(all, "cavity/" + model.lumens[lumen].name + "/x", &CellVariable::name) - all.begin());
}

void number_trait_variables(Model& model) {
  const std::vector<CellVariable> all = cell_variables(model);
  for (const Trait trait : kTraits) {
    const auto found = std::ranges::find(all, name_of(trait), &CellVariable::name);
    const int number = found == all.end() ? -1 : static_cast<int>(found - all.begin());
    for (CellType& type : model.types) type.traits.variable[number_of(trait)] = number;
  }
}

}  // namespace morula
