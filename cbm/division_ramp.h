#pragma once
#include "core/cell_id.h"
#include "core/numbers/cube_root.h"

namespace morula::cbm {

/// Time over which the rest distance of two fresh sisters grows to that of an ordinary pair [s]. A choice of this project: animal cells take some
/// half an hour from the furrow until the daughters have parted. Spheres that keep their volume follow it closely, at 0.6 R each, so that it
/// also sets how far the centres go in a step (decision 0025).
inline constexpr double kSisterRelaxation = 1800.0;

/// Whether the two cells are the two daughters of one division.
[[nodiscard]] constexpr bool are_sisters(CellId a, CellId b) noexcept {
  return (a.bits() ^ b.bits()) == (std::uint64_t{1} << CellId::kFounderBits) && a.generation() > 0 && b.generation() > 0;
}

/// Whether sisters that were born then are an ordinary pair by now [s].
[[nodiscard]] constexpr bool sisters_have_parted(double birth_time, double now) noexcept { return now - birth_time >= kSisterRelaxation; }

/// Distance of the centres of two daughters at birth, such that both lie inside their mother's envelope and touch it at most [µm].
///
/// The centres lie at d·V_2/V_m and d·V_1/V_m from the mother's, so that d·V_2/V_m + r_1 ≤ R_m and d·V_1/V_m + r_2 ≤ R_m. Equal daughters:
/// d = 2(R_m − r) = 0.4125989 R_m. r_1, r_2: radii of the daughters at birth; R_m³ = r_1³ + r_2³.
[[nodiscard]] constexpr double sister_distance(double radius_1, double radius_2) noexcept {
  const double volume_1 = radius_1 * radius_1 * radius_1;
  const double volume_2 = radius_2 * radius_2 * radius_2;
  const double mother_volume = volume_1 + volume_2;
  const double mother = cube_root(mother_volume);
  const double first = (mother - radius_1) * mother_volume / volume_2;
  const double second = (mother - radius_2) * mother_volume / volume_1;
  return first < second ? first : second;
}

/// How much of the overlap of two fresh sisters is forgiven [µm]: the contact law of the pair is evaluated at δ − offset.
///
/// The rest distance of the pair grows linearly over `relaxation` from the birth distance to the zero-load distance of its law,
/// R_i + R_j − δ_0; so offset = (R_i + R_j − δ_0 − d_birth)·(1 − age/relaxation), and 0 from then on, and the pair is born without load.
///
/// rest_overlap: δ_0 of the pair's law [µm]; radius_i, radius_j: as they are now; birth_radius_i, birth_radius_j: at division [µm]; age: time since division [s].
[[nodiscard]] constexpr double sister_overlap_offset(double rest_overlap, double radius_i, double radius_j, double birth_radius_i,
                                                     double birth_radius_j, double age, double relaxation = kSisterRelaxation) noexcept {
  if (!(age < relaxation)) return 0.0;
  const double to_go = radius_i + radius_j - rest_overlap - sister_distance(birth_radius_i, birth_radius_j);
  if (to_go <= 0.0) return 0.0;  // adhesion so strong that sisters at birth already pull: nothing to forgive
  return to_go * (age <= 0.0 ? 1.0 : 1.0 - age / relaxation);
}

}  // namespace morula::cbm
