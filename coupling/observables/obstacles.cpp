#include "coupling/observables/measures.h"
#include "coupling/observables/observable.h"

namespace morula {

std::vector<Observable> obstacle_observables(const Model& model) {
  std::vector<Observable> out;
  for (std::size_t o = 0; o < model.obstacles.size(); ++o) {
    const std::string& name = model.obstacles[o].name;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string letter(1, "xyz"[axis]);
      out.push_back({"force_" + letter + "_" + name, "nN",
                     "Force of all cells on the obstacle " + name + " along " + letter +
                         ", from contact and adhesion. Friction is left out, across the contact, too: a cell that a load presses onto it "
                         "comes to bear on it as slowly as "
                         "that lets it come.",
                     [o, axis](const Moment& m) { return m.measures.obstacle_force[o][axis]; }});
    }
  }
  return out;
}

}  // namespace morula
