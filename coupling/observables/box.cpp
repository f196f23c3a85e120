#include "coupling/changing_box.h"
#include "coupling/observables/measures.h"
#include "coupling/observables/observable.h"

namespace morula {
namespace {

using Part = double SymMat3<double>::*;

/// Σ V_i σ_i of all cells over the volume of the box: the virial stress of what acts between the cells, as the contact stress of each tells it
/// (decision 0023), without friction [kPa]. Collective.
double stress_of_box(const Moment& m, Part part) {
  return m.cells.sum([part](const CellView& cell) { return cell.stressed_volume * cell.stress.*part; }) / m.measures.box_volume;
}

}  // namespace

std::vector<Observable> box_observables(const Model& model) {
  using M = const Moment&;
  using S = SymMat3<double>;
  if (!periodic_along_all_axes(model.space)) return {};
  std::vector<Observable> out{{"box_volume", "um^3", "Volume of the periodic box.", [](M m) { return m.measures.box_volume; }},
                              {"box_pressure", "kPa", "Pressure of the tissue in the periodic box, -tr(stress)/3.", [](M m) {
                                 return -(stress_of_box(m, &S::xx) + stress_of_box(m, &S::yy) + stress_of_box(m, &S::zz)) / 3.0;
                               }}};
  const auto add = [&out](const char* axes, Part part) {
    out.push_back({std::string("stress_") + axes, "kPa",
                   std::string("Stress of the tissue in the periodic box, tension positive, ") + axes +
                       ": what neighbours put on the cells, times their volumes, over the box.",
                   [part](M m) { return stress_of_box(m, part); }});
  };
  add("xx", &S::xx), add("yy", &S::yy), add("zz", &S::zz), add("xy", &S::xy), add("xz", &S::xz), add("yz", &S::yz);
  return out;
}

}  // namespace morula
