#include "coupling/observables/measures.h"
#include "coupling/observables/observable.h"

namespace morula {

std::vector<Observable> lumen_observables(const Model& model) {
  std::vector<Observable> out;
  for (std::size_t k = 0; k < model.lumens.size(); ++k) {
    const std::string& name = model.lumens[k].name;
    const auto of = [k](double LumenState::*member) { return [k, member](const Moment& m) { return m.measures.lumens[k].*member; }; };
    out.push_back({"volume_" + name, "um^3", "Volume of the cavity " + name + ".", of(&LumenState::volume)});
    out.push_back({"area_" + name, "um^2", "Area of the faces that bound the cavity " + name + ".", of(&LumenState::area)});
    out.push_back({"pressure_" + name, "kPa", "Pressure of the fluid in the cavity " + name + ".", of(&LumenState::pressure)});
    out.push_back({"open_" + name, "1", "Part of the directions from the centre of the cavity " + name + " in which it has no wall.",
                   [k](const Moment& m) { return 1.0 - m.measures.lumens[k].covered; }});
  }
  return out;
}

}  // namespace morula
