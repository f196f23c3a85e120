#include <algorithm>

#include "coupling/observables/measures.h"
#include "coupling/observables/observable.h"

namespace morula {

std::vector<Observable> type_observables(const Model& model) {
  std::vector<Observable> out;
  for (std::size_t t = 0; t < model.types.size(); ++t)
    out.push_back({"count_" + model.types[t].name, "1", "Number of cells of the type " + model.types[t].name + ".",
                   [t](const Moment& m) { return double(m.measures.of_type[t]); }});
  if (std::any_of(model.types.begin(), model.types.end(), [](const CellType& type) { return type.interior.has_nuclear_shell(); }))
    out.push_back({"nucleus_clearance", "um", "Least distance of a node of a nucleus from the cortex around it; negative: outside.",
                   [](const Moment& m) { return m.measures.nucleus_clearance; }});
  return out;
}

}  // namespace morula
