#include <algorithm>

#include "coupling/observables/observable.h"

namespace morula {

std::vector<Observable> phase_observables(const Model& model) {
  std::vector<std::string> names;
  const auto add = [&names](const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const CellType& type : model.types)
    for (const CyclePhase& phase : type.cycle.phases) add(phase.name);
  if (std::ranges::any_of(model.types, [](const CellType& type) { return type.cycle.quiescence.phase >= 0; })) add(kQuiescentPhase);

  std::vector<Observable> out;
  for (const std::string& name : names)
    out.push_back({"cells_in_" + name, "1", "Number of cells in the phase " + name + " of their cycle.", [name](const Moment& m) {
                     return m.cells.sum([&name](const CellView& cell) { return cell.phase_name() == name ? 1.0 : 0.0; });
                   }});
  return out;
}

}  // namespace morula
