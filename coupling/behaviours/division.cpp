#include "coupling/behaviours/division.h"

#include <cassert>

#include "cbm/division_ramp.h"
#include "core/numbers/cube_root.h"
#include "core/random/philox.h"
#include "coupling/behaviours/birth.h"
#include "coupling/behaviours/growth.h"

namespace morula {
SphereDivision divide_sphere(const FullRow& mother, const SphereBody& body, const CellType& type, std::uint32_t seed, double time,
                             double late, double fraction) {
  assert(mother.id.can_divide() && fraction > 0.0 && fraction < 1.0);
  const double volume_1 = fraction * mother.target_volume;
  const double volume_2 = mother.target_volume - volume_1;
  const double share_1 = volume_1 / mother.target_volume;
  const double share_2 = volume_2 / mother.target_volume;

  SphereDivision out;
  const double birth = time - late;
  out.first = make_daughter(mother, 0, type, seed, birth, volume_1);
  out.second = make_daughter(mother, 1, type, seed, birth, volume_2);
  if (late > 0.0) {
    grow(out.first, type, late);
    grow(out.second, type, late);
  }

  const Vec3d axis = Random(seed, RandomStream::kDivisionAxis).direction(mother.id, mother.draws);
  out.first_body.radius = body.radius * cube_root(share_1);
  out.second_body.radius = body.radius * cube_root(share_2);
  const double distance = cbm::sister_distance(out.first_body.radius, out.second_body.radius);
  out.first_body.position = body.position + (distance * share_2) * axis;
  out.second_body.position = body.position - (distance * share_1) * axis;
  return out;
}

void divide_variables(std::span<const VariableColumn> variables, const FullRow& mother, FullRow& first, FullRow& second) {
  assert(first.birth_volume > 0.0 && first.birth_volume < mother.target_volume);
  const double part = first.birth_volume / mother.target_volume;
  const auto daughter = [&](bool is_first) {
    std::vector<double> out;
    for (std::size_t v = 0; v < variables.size(); ++v) {
      const double mothers = mother.variable(v), shared = part * mothers;
      const AtDivision rule = variables[v].what.at_division;
      out.push_back(rule == AtDivision::kCopied ? mothers : rule != AtDivision::kShared ? 0.0 : is_first ? shared : mothers - shared);
    }
    return out;
  };
  first.variables = daughter(true);
  second.variables = daughter(false);
}

}  // namespace morula
