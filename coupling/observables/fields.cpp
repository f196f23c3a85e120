#include <algorithm>

#include "coupling/changing_box.h"
#include "coupling/observables/measures.h"
#include "coupling/observables/observable.h"

namespace morula {

std::vector<Observable> field_observables(const Model& model) {
  std::vector<Observable> out;
  for (std::size_t f = 0; f < model.fields.size(); ++f) {
    const std::string& name = model.fields[f].name;
    out.push_back({"mean_" + name, "mM", "Mean concentration of " + name + ".", [f](const Moment& m) { return m.measures.mean_field[f]; }});
    out.push_back(
        {"min_" + name, "mM", "Smallest concentration of " + name + ".", [f](const Moment& m) { return m.measures.least_field[f]; }});
    out.push_back({"balance_" + name, "1", "Relative error of the balance of amounts of " + name + " since time 0.",
                   [f](const Moment& m) { return m.measures.field_balance[f]; }});
  }
  if (!model.fields.empty() && !periodic_along_all_axes(model.space))
    out.push_back(
        {"outside_fields", "1",
         "Cells whose centre lies beyond a face of the domain, where no field is: they see and take what is in its outermost voxels.",
         [](const Moment& m) { return double(m.measures.outside_fields); }});
  if (!model.fields.empty())
    out.push_back({"field_balance", "1", "Largest relative error of the balance of amounts over all fields.",
                   [](const Moment& m) { return *std::max_element(m.measures.field_balance.begin(), m.measures.field_balance.end()); }});
  return out;
}

}  // namespace morula
