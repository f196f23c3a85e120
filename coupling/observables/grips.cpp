#include "coupling/observables/measures.h"
#include "coupling/observables/observable.h"

namespace morula {

std::vector<Observable> grip_observables(const Model& model) {
  std::vector<Observable> out;
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    if (!model.loads[l].what->holds()) continue;
    const std::string& name = model.loads[l].name;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string letter(1, "xyz"[axis]);
      out.push_back({"grip_" + letter + "_" + name, "nN", "Force of the grip or trap " + name + " on its cells along " + letter + ".",
                     [l, axis](const Moment& m) { return m.measures.grip_force[l][axis]; }});
    }
  }
  return out;
}

}  // namespace morula
