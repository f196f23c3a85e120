#include "coupling/cell_variables.h"

#include <algorithm>
#include <utility>

namespace morula {

std::vector<CellVariable> cell_variables(const Model& model) {
  std::vector<CellVariable> out;
  for (const fields::FieldSpec& field : model.fields) {
    out.push_back({"amount/" + field.name, "amol", AtDivision::kShared});
    out.push_back({"concentration/" + field.name, "mM", AtDivision::kCopied});
  }
  if (std::ranges::any_of(model.types, [](const CellType& type) { return !type.cycle.phases.empty(); }))
    for (const auto& [name, unit] : {std::pair(kPhaseVariable, "1"), {"cycle/left", "s"}, {"cycle/held", "s"}})
      out.push_back({name, unit, AtDivision::kSet});
  for (const CellType& type : model.types)
    for (const CellBehaviour& behaviour : type.behaviours)
      for (const BehaviourVariable& variable : behaviour.what->variables) {
        const CellVariable one{behaviour.what->info.name + "/" + variable.name, variable.unit,
                               variable.shared ? AtDivision::kShared : AtDivision::kCopied};
        if (std::ranges::find(out, one) == out.end()) out.push_back(one);
      }
  return out;
}

}  // namespace morula
