#include "coupling/behaviours/division.h"

#include "cbm/division_ramp.h"
#include "core/numbers/cube_root.h"
#include "core/random/philox.h"
#include "coupling/behaviours/birth.h"
#include "coupling/behaviours/growth.h"

namespace morula {
namespace {

void share(double mothers, double part, double& first, double& second) {
  first = part * mothers;
  second = mothers - first;
}
template <std::size_t kSize>
void share(const std::array<double, kSize>& mothers, double part, std::array<double, kSize>& first, std::array<double, kSize>& second) {
  for (std::size_t i = 0; i < kSize; ++i) share(mothers[i], part, first[i], second[i]);
}

/// What daughters share of their mother's columns, the first `part` of it.
void share_columns(const FullRow& mother, double part, FullRow& first, FullRow& second) {
  for_each_cell_column([&](const CellColumn& column, auto member) {
    if constexpr (requires { share(mother.*member, part, first.*member, second.*member); })
      if (column.at_division == AtDivision::kShared) share(mother.*member, part, first.*member, second.*member);
  });
}

}  // namespace

SphereDivision divide_sphere(const FullRow& mother, const SphereBody& body, const CellType& type, std::uint32_t seed, double time,
                             double late, double fraction) {
  const double volume_1 = fraction * mother.target_volume;
  const double volume_2 = mother.target_volume - volume_1;
  const double share_1 = volume_1 / mother.target_volume;
  const double share_2 = volume_2 / mother.target_volume;

  SphereDivision out;
  const double birth = time - late;
  out.first = make_daughter(mother, 0, type, seed, birth, volume_1);
  out.second = make_daughter(mother, 1, type, seed, birth, volume_2);
  share_columns(mother, share_1, out.first, out.second);
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

}  // namespace morula
