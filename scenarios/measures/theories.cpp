#include "scenarios/measures/theories.h"

#include <algorithm>

#include "core/numbers/joined.h"

namespace morula::scenarios {

std::string Theory::predictions() const {
  return joined(predicts, [](const std::string& one) { return one + (one.ends_with('_') ? "<name>" : ""); });
}

bool Theory::is_about(const std::string& measure) const {
  return std::any_of(predicts.begin(), predicts.end(),
                     [&](const std::string& one) { return one == measure || (one.ends_with('_') && measure.starts_with(one)); });
}

const std::vector<Theory>& theories() {
  static const std::vector<Theory> all{
      youngs_law(),       elastic_cap_theory(),      laplace_law(), jkr_pull_off(),       filled_box(),          fluid_pull_off(),
      critical_suction(), stretched_sphere_theory(), hull_volume(), exponential_growth(), pressed_drop_theory(),
  };
  return all;
}

const Theory* find_theory(const std::string& name) {
  const auto found = std::find_if(theories().begin(), theories().end(), [&](const Theory& t) { return t.name == name; });
  return found == theories().end() ? nullptr : &*found;
}

std::vector<std::string> theory_names() {
  std::vector<std::string> out;
  for (const Theory& theory : theories()) out.push_back(theory.name);
  return out;
}

}  // namespace morula::scenarios
